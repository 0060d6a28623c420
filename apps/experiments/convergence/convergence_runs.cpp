// SPDX-License-Identifier: BSD-3-Clause
#include "convergence_runs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <iostream>
#include <limits>
#include <map>
#include <set>

#include "experiments/experiment.hpp"

namespace lockbox::app {
namespace {

constexpr double kHalf = 50.0;  // percent

bool succeeds(const ConvergenceRun& run, const Tolerances& success) {
  return run.translation <= success.translation && run.rotation <= success.rotation;
}

struct Count {
  int all = 0;
  int good = 0;

  void add(bool is_good) {
    ++all;
    good += is_good ? 1 : 0;
  }
  double percent() const {
    return all == 0 ? std::numeric_limits<double>::quiet_NaN() : 100.0 * good / all;
  }
};

/// How many of the runs that qualify are good.
Count count(const std::vector<ConvergenceRun>& runs,
            const std::function<bool(const ConvergenceRun&)>& qualifies,
            const std::function<bool(const ConvergenceRun&)>& is_good) {
  Count result;
  for (const ConvergenceRun& run : runs) {
    if (qualifies(run)) result.add(is_good(run));
  }
  return result;
}

/// Success by start error.
HeatMap success_map(const std::vector<ConvergenceRun>& runs, const Tolerances& success) {
  std::set<double> translations;
  std::set<double> rotations;
  std::map<std::pair<double, double>, Count> cells;
  for (const ConvergenceRun& run : runs) {
    translations.insert(run.start_translation);
    rotations.insert(run.start_rotation);
    cells[{run.start_translation, run.start_rotation}].add(succeeds(run, success));
  }
  HeatMap map{"runs that succeed (%)",
              {translations.begin(), translations.end()},
              {rotations.begin(), rotations.end()},
              {}};
  for (const double rotation : map.y) {
    for (const double translation : map.x) {
      map.values.push_back(cells[{translation, rotation}].percent());
    }
  }
  return map;
}

/// Returns for each rotation the translation at which success first falls to a half, between the
/// cells' centres by linear interpolation; NaN where it does not.
Curve half_contour(const HeatMap& map) {
  Curve contour{"50 %", {}, map.y};
  const std::size_t columns = map.x.size();
  for (std::size_t row = 0; row < map.y.size(); ++row) {
    const auto value = [&](std::size_t column) { return map.values[row * columns + column]; };
    double crossing = std::numeric_limits<double>::quiet_NaN();
    if (value(0) < kHalf) crossing = map.x[0];
    for (std::size_t c = 1; c < columns; ++c) {
      if (value(c - 1) >= kHalf && value(c) < kHalf) {
        const double share = (value(c - 1) - kHalf) / (value(c - 1) - value(c));
        crossing = map.x[c - 1] + share * (map.x[c] - map.x[c - 1]);
        break;
      }
    }
    contour.x.push_back(crossing);
  }
  return contour;
}

std::map<std::string, std::vector<ConvergenceRun>> by_variant(
    const std::vector<ConvergenceRun>& runs) {
  std::map<std::string, std::vector<ConvergenceRun>> variants;
  for (const ConvergenceRun& run : runs) variants[run.variant.text()].push_back(run);
  return variants;
}

void print_count(const std::string& what, const Count& counted) {
  std::cout << "  " << what << ": " << counted.good << " of " << counted.all;
  if (counted.all > 0) std::cout << " (" << counted.percent() << " %)";
  std::cout << '\n';
}

void print_contour(const HeatMap& map) {
  const Curve contour = half_contour(map);
  std::cout << "  half of the runs succeed up to";
  for (std::size_t i = 0; i < contour.y.size(); ++i) {
    std::cout << (i == 0 ? " " : ", ");
    if (std::isfinite(contour.x[i])) {
      std::cout << contour.x[i];
    } else {
      std::cout << "over " << map.x.back();
    }
    std::cout << " cm at " << contour.y[i];
  }
  std::cout << " degrees\n";
}

}  // namespace

const std::vector<std::string>& convergence_columns() {
  static const std::vector<std::string> columns = {"tracker",
                                                   "joints",
                                                   "start_translation_cm",
                                                   "start_rotation_degrees",
                                                   "sample",
                                                   "status",
                                                   "searches",
                                                   "frames",
                                                   "translation",
                                                   "rotation",
                                                   "joint_error",
                                                   "worst_joint",
                                                   "frames_tracking",
                                                   "frames_trusted_wrongly",
                                                   "frames_right",
                                                   "frames_right_not_tracking"};
  return columns;
}

std::string Variant::text() const {
  return (tracker == "whole" ? "whole tracker" : "registration alone") + (", joints " + joints);
}

Row to_row(const ConvergenceRun& run) {
  return {run.variant.tracker,
          run.variant.joints,
          run.start_translation,
          run.start_rotation,
          run.sample,
          run.status,
          run.searches,
          run.frames,
          run.translation,
          run.rotation,
          run.joints,
          run.worst_joint,
          run.statuses.tracking,
          run.statuses.tracking_but_wrong,
          run.statuses.right,
          run.statuses.right_but_not_tracking};
}

ConvergenceRun from_row(const Table& table, const Row& row) {
  const auto number = [&](const char* column) { return table.number(row, column); };
  const auto count = [&](const char* column) { return static_cast<std::size_t>(number(column)); };
  return {{table.word(row, "tracker"), table.word(row, "joints")},
          number("start_translation_cm"),
          number("start_rotation_degrees"),
          static_cast<int>(number("sample")),
          table.word(row, "status"),
          static_cast<int>(number("searches")),
          static_cast<int>(number("frames")),
          number("translation"),
          number("rotation"),
          number("joint_error"),
          table.word(row, "worst_joint"),
          {count("frames_tracking"), count("frames_trusted_wrongly"), count("frames_right"),
           count("frames_right_not_tracking")}};
}

std::string key(const ConvergenceRun& run) {
  std::string text;
  const Row row = to_row(run);
  for (std::size_t i = 0; i < 5; ++i) text += row[i].text + ',';
  return text;
}

void print_convergence(const std::vector<ConvergenceRun>& runs, const Tolerances& success) {
  const auto within = [](double centimetres, double degrees) {
    return [=](const ConvergenceRun& run) {
      return run.start_translation <= centimetres && run.start_rotation <= degrees;
    };
  };
  const auto all = [](const ConvergenceRun&) { return true; };
  const auto good = [&](const ConvergenceRun& run) { return succeeds(run, success); };
  std::cout << std::fixed << std::setprecision(1);
  for (const auto& [name, own] : by_variant(runs)) {
    std::cout << '\n' << name << '\n';
    print_count("succeed", count(own, all, good));
    print_count("succeed from within 10 cm and 15 degrees", count(own, within(10.0, 15.0), good));
    print_count(
        "re-initialised from within 5 cm and 5 degrees",
        count(own, within(5.0, 5.0), [](const ConvergenceRun& run) { return run.searches > 0; }));
    print_count("fail, but are called tracking", count(own, all, [&](const ConvergenceRun& run) {
                  return !good(run) && run.status == "tracking";
                }));
    print_count(
        "succeed, with an observable joint beyond its tolerance",
        count(own, all, [&](const ConvergenceRun& run) { return good(run) && run.joints > 1.0; }));
    print_contour(success_map(own, success));
    StatusCount statuses;
    for (const ConvergenceRun& run : own) statuses += run.statuses;
    print_status_count(statuses);
  }
}

Figure convergence_figure(const std::string& name, const std::vector<ConvergenceRun>& runs,
                          const Tolerances& success) {
  Figure figure{name + ": runs that succeed, by the error of the start", {}};
  for (const auto& [variant, own] : by_variant(runs)) {
    const HeatMap map = success_map(own, success);
    const Curve contour = half_contour(map);
    const bool is_crossed =
        std::any_of(contour.x.begin(), contour.x.end(), [](double x) { return std::isfinite(x); });
    figure.panels.push_back({"translation of the start (cm)", "rotation (degrees)",
                             is_crossed ? std::vector<Curve>{contour} : std::vector<Curve>{}, false,
                             variant, map});
  }
  return figure;
}

}  // namespace lockbox::app
