// SPDX-License-Identifier: BSD-3-Clause
#include "mismatch_report.hpp"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>

#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/statistics.hpp"
#include "lockbox/simulation/deviation_presets.hpp"

namespace lockbox::app {
namespace {

/// Over the frames of a kind.
struct KindSummary {
  std::size_t frames = 0;
  std::size_t right = 0;
  std::size_t tracking = 0;
  std::size_t trusted_wrongly = 0;
  std::map<std::string, std::vector<double>> errors;  ///< by column, of frames called tracking
};

const std::vector<std::string>& error_columns() {
  static const std::vector<std::string> columns = {
      "translation", "rotation",       "plain_translation", "plain_rotation",
      "joint_error", "base_in_sigmas", "joint_in_sigmas"};
  return columns;
}

std::map<std::string, KindSummary> summarized(const std::vector<std::filesystem::path>& files) {
  std::map<std::string, KindSummary> kinds;
  for (const auto& file : files) {
    const Table table = read_table(file, mismatch_columns());
    for (const Row& row : table.rows()) {
      KindSummary& kind = kinds[table.word(row, "kind")];
      const bool is_right = table.number(row, "right") != 0.0;
      ++kind.frames;
      kind.right += is_right ? 1 : 0;
      if (table.word(row, "status") != to_string(TrackingStatus::tracking)) continue;
      ++kind.tracking;
      kind.trusted_wrongly += is_right ? 0 : 1;
      for (const std::string& column : error_columns()) {
        kind.errors[column].push_back(table.number(row, column));
      }
    }
  }
  return kinds;
}

/// Median and 95 %, in that unit.
std::string quantiles(const std::vector<double>& errors, double unit, int digits) {
  const Statistics statistics = summarize(errors);
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << unit * statistics.median << '/'
       << unit * statistics.percentile_95;
  return text.str();
}

void print_kind(const std::string& name, const KindSummary& kind) {
  std::cout << std::left << std::setw(15) << name << std::right << std::setw(7) << kind.frames
            << std::setw(9) << kind.tracking << std::setw(7) << kind.right << std::setw(8)
            << kind.trusted_wrongly;
  if (kind.tracking > 0) {
    const auto& errors = kind.errors;
    std::cout << std::setw(13) << quantiles(errors.at("translation"), kMillimetres, 1)
              << std::setw(12) << quantiles(errors.at("rotation"), kDegrees, 2) << std::setw(13)
              << quantiles(errors.at("plain_translation"), kMillimetres, 1) << std::setw(12)
              << quantiles(errors.at("plain_rotation"), kDegrees, 2) << std::setw(12)
              << quantiles(errors.at("joint_error"), 100.0, 0) << std::fixed << std::setprecision(1)
              << std::setw(8) << summarize(errors.at("base_in_sigmas")).percentile_95
              << std::setw(8) << summarize(errors.at("joint_in_sigmas")).percentile_95;
  }
  std::cout << '\n';
}

}  // namespace

const std::vector<std::string>& mismatch_kinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> all = deviation_kinds();
    all.insert(all.end(), {"stereo", "time-of-flight"});
    return all;
  }();
  return kinds;
}

std::vector<std::string> mismatch_columns() {
  return {"kind",           "seed",        "frame",       "status",
          "right",          "translation", "rotation",    "plain_translation",
          "plain_rotation", "joint_error", "worst_joint", "base_in_sigmas",
          "joint_in_sigmas"};
}

void add_mismatch_rows(Table& table, const std::string& kind, std::uint64_t seed,
                       const std::vector<MismatchFrame>& frames) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const MismatchFrame& frame = frames[i];
    const FrameOutcome& outcome = frame.outcome;
    table.add({kind, seed, i, to_string(outcome.status), frame.is_right ? 1 : 0,
               outcome.translation, outcome.rotation, frame.plain_translation, frame.plain_rotation,
               outcome.joints, outcome.worst_joint, frame.base_in_sigmas, frame.joint_in_sigmas});
  }
}

void print_mismatch_report(const std::string& title,
                           const std::vector<std::filesystem::path>& files) {
  const auto kinds = summarized(files);
  std::cout
      << '\n'
      << title
      << ": median/95 % of frames called tracking; joints: worst one, % of 1 cm or 5 "
         "degrees;\nplain: against the true pose; error/sigma: 95 %\n"
      << "kind            frames tracking  right trusted      base, mm     base, °    plain, mm"
         "    plain, °   joints, %  base/s joint/s\n"
      << "                                        wrongly\n";
  for (const std::string& name : mismatch_kinds()) {
    const auto kind = kinds.find(name);
    if (kind != kinds.end()) print_kind(name, kind->second);
  }
}

}  // namespace lockbox::app
