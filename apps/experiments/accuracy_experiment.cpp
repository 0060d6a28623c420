// SPDX-License-Identifier: BSD-3-Clause
// Single frames of random scenes, each aligned to convergence from a start of its own, against the
// bound that the sensor's noise puts on any estimate.
#include "lockbox/evaluation/accuracy_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <numbers>
#include <set>

#include "command_line/interruption.hpp"
#include "command_line/option_checks.hpp"
#include "command_line/progress.hpp"
#include "experiments.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/statistics.hpp"
#include "lockbox/evaluation/table.hpp"
#include "lockbox/evaluation/unknowns.hpp"
#include "shard.hpp"

namespace lockbox::app {
namespace {

const std::vector<std::string>& columns() {
  static const std::vector<std::string> names = {"scene", "unknown",    "error",
                                                 "sigma", "observable", "bound"};
  return names;
}

/// All frames' errors, by unknown.
using ErrorsByUnknown = std::vector<std::vector<UnknownError>>;

ErrorsByUnknown read_errors(const std::filesystem::path& stem, const KinematicTree& tree) {
  const auto names = unknown_names(tree);
  std::map<std::pair<double, std::string>, UnknownError> by_row;
  for (const auto& file : rows_files(stem)) {
    const Table table = read_table(file, columns());
    for (const Row& row : table.rows()) {
      by_row[{table.number(row, "scene"), table.word(row, "unknown")}] = {
          table.number(row, "error"), table.number(row, "sigma"),
          table.number(row, "observable") != 0.0, table.number(row, "bound")};
    }
  }
  ErrorsByUnknown errors(names.size());
  for (const auto& [row, error] : by_row) {
    const auto unknown = std::find(names.begin(), names.end(), row.second) - names.begin();
    if (unknown < static_cast<std::ptrdiff_t>(names.size())) {
      errors[static_cast<std::size_t>(unknown)].push_back(error);
    }
  }
  return errors;
}

/// Of one unknown, over the frames that tell of it.
struct AgainstBound {
  std::vector<double> errors;
  std::vector<double> bounds;
  double allowed = 0.0;     ///< root mean square
  double of_allowed = 0.0;  ///< root mean square of error / allowed
  std::size_t observable = 0;
  double normalised = 0.0;  ///< mean square of error / sigma, where it is called observable
  std::size_t beyond_four_sigma = 0;
};

AgainstBound against_bound(const KinematicTree& tree, int unknown,
                           const std::vector<UnknownError>& frames) {
  AgainstBound result;
  for (const UnknownError& frame : frames) {
    if (!is_told(tree, unknown, frame.bound)) continue;
    const double allowed = allowed_error(tree, unknown, frame.bound);
    result.errors.push_back(frame.error);
    result.bounds.push_back(frame.bound);
    result.allowed += allowed * allowed;
    result.of_allowed += std::pow(frame.error / allowed, 2);
    if (!frame.observable) continue;
    const double normalised = frame.error / frame.sigma;
    ++result.observable;
    result.normalised += normalised * normalised;
    result.beyond_four_sigma += std::abs(normalised) > 4.0 ? 1 : 0;
  }
  const auto count = static_cast<double>(result.errors.size());
  result.allowed = std::sqrt(result.allowed / count);
  result.of_allowed = std::sqrt(result.of_allowed / count);
  result.normalised /= static_cast<double>(result.observable);
  return result;
}

void print_summary(const KinematicTree& tree, const ErrorsByUnknown& all) {
  const auto names = unknown_names(tree);
  std::cout
      << "\nErrors in mm and degrees, over the frames whose bound is below 5 mm or 2 degrees\n"
      << std::left << std::setw(18) << "unknown" << std::right << "frames  bound (median)"
      << "    RMSE  allowed  error/allowed (rms)  (error/sigma)^2  > 4 sigma\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int unknown = static_cast<int>(i);
    const AgainstBound of = against_bound(tree, unknown, all[i]);
    const double scale = is_length(tree, unknown) ? kMillimetres : kDegrees;
    std::cout << std::left << std::setw(18) << names[i] << std::right << std::setw(6)
              << of.errors.size();
    if (of.errors.empty()) {
      std::cout << '\n';
      continue;
    }
    std::cout << std::fixed << std::setprecision(4) << std::setw(16)
              << scale * summarize(of.bounds).median << std::setw(8)
              << scale * summarize(of.errors).rmse << std::setw(9) << scale * of.allowed
              << std::setprecision(2) << std::setw(21) << of.of_allowed << std::setw(17)
              << of.normalised << std::setw(11) << of.beyond_four_sigma << '\n';
  }
}

/// How many errors are at most so many bounds, by kind of unknown; a Gaussian estimate at the bound
/// itself beside them.
Figure accuracy_figure(const KinematicTree& tree, const ErrorsByUnknown& all) {
  constexpr double kMost = 6.0;
  std::map<std::string, std::vector<double>> ratios;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int unknown = static_cast<int>(i);
    const bool length = is_length(tree, unknown);
    const std::string kind = unknown < kBaseUnknowns
                                 ? (length ? "base, translation" : "base, rotation")
                                 : (length ? "sliding joints" : "turning joints");
    for (const UnknownError& frame : all[i]) {
      if (is_told(tree, unknown, frame.bound)) {
        ratios[kind].push_back(std::abs(frame.error) / frame.bound);
      }
    }
  }
  Panel panel{"error / bound", "frames and unknowns (%)", {}};
  for (auto& [kind, values] : ratios) {
    std::sort(values.begin(), values.end());
    Curve curve{kind, {}, {}};
    for (std::size_t i = 0; i < values.size() && values[i] <= kMost; ++i) {
      curve.x.push_back(values[i]);
      curve.y.push_back(100.0 * static_cast<double>(i + 1) / static_cast<double>(values.size()));
    }
    panel.curves.push_back(curve);
  }
  Curve limit{"at the bound", {}, {}};
  for (double x = 0.0; x <= kMost; x += 0.1) {
    limit.x.push_back(x);
    limit.y.push_back(100.0 * std::erf(x / std::numbers::sqrt2));
  }
  panel.curves.push_back(limit);
  return {tree.name + ": single frames, against the bound", {panel}};
}

class Accuracy : public Experiment {
 public:
  bool continues() const override { return true; }

  void add_options(CLI::App& options) override {
    options.add_option("--scenes", scenes_, "Number of random scenes, one frame each")
        ->check(positive());
    options.add_option("--points", point_budget_, "Points that are used, about; 0: all")
        ->check(not_negative());
    shard_.add_to(options);
  }

 private:
  /// Aligns the scenes that have no rows yet; sums up the rows of all shards.
  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    const auto stem = settings.output / ("accuracy_" + model.tree.name + "_" + settings.sensor +
                                         "_" + std::to_string(point_budget_) + "points_seed" +
                                         std::to_string(settings.seed));
    const auto file = shard_.rows_file(stem);
    Table table = continued_table(file, columns());
    RegistrationOptions options;
    options.point_budget = point_budget_;
    const SensorModel sensor = sensor_model(settings.sensor);
    AccuracyExperiment experiment(model, sensor.camera, sensor, settings.seed, options, Executor());
    const auto names = unknown_names(model.tree);
    const Interruption interruption;
    Progress progress("accuracy " + model.tree.name, shard_.runs_of(scenes_), settings.quiet,
                      "scenes");
    for (std::uint64_t scene = 0; scene < scenes_ && !interruption.requested(); ++scene) {
      if (!shard_.holds(scene)) continue;
      if (!has_scene(table, scene)) {
        const auto errors = experiment.align_frame(scene);
        for (std::size_t i = 0; i < errors.size(); ++i) {
          table.add({scene, names[i], errors[i].error, errors[i].sigma,
                     errors[i].observable ? 1 : 0, errors[i].bound});
        }
        write_table(file, table);
      }
      progress.update(table.rows().size() / names.size());
    }
    progress.finish();
    const auto all = read_errors(stem, model.tree);
    print_summary(model.tree, all);
    draw(stem, accuracy_figure(model.tree, all));
    return !interruption.requested();
  }

  static bool has_scene(const Table& table, std::uint64_t scene) {
    return std::any_of(table.rows().begin(), table.rows().end(), [&](const Row& row) {
      return table.number(row, "scene") == static_cast<double>(scene);
    });
  }

  std::uint64_t scenes_ = 200;
  std::size_t point_budget_ = RegistrationOptions{}.point_budget;
  Shard shard_;
};

}  // namespace

std::unique_ptr<Experiment> make_accuracy_experiment() {
  return std::make_unique<Accuracy>();
}

}  // namespace lockbox::app
