// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/matching_stamps.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/stamp_unit.hpp"
#include "lockbox/evaluation/nearest_stamp.hpp"

namespace lockbox {
namespace {

std::vector<double> stamps_in(const StatesFile& file) {
  std::vector<double> stamps;
  for (const State& state : file.states) stamps.push_back(state.stamp);
  return stamps;
}

std::vector<double> sorted_stamps(const StatesFile& file) {
  std::vector<double> stamps = stamps_in(file);
  std::sort(stamps.begin(), stamps.end());
  return stamps;
}

/// other_is_in_seconds: then milliseconds that need not be some are some.
void convert(StatesFile& file, const char* role, bool other_is_in_seconds,
             std::vector<std::string>& remarks) {
  const auto unit = other_stamp_unit(stamps_in(file));
  if (!unit || !(unit->certain || other_is_in_seconds)) return;
  for (State& state : file.states) state.stamp /= unit->per_second;
  remarks.push_back(std::string("the timestamps of the ") + role + " are taken for " + unit->name);
}

std::string range_text(const std::vector<double>& stamps) {
  const auto rounded = [](double value) {
    return fixed_number_text(std::round(value * 1e3) / 1e3);
  };
  return rounded(stamps.front()) + " s to " + rounded(stamps.back()) + " s";
}

bool is_as_long(const std::vector<double>& a, const std::vector<double>& b) {
  const double one = a.back() - a.front();
  const double other = b.back() - b.front();
  return std::abs(one - other) <= 0.2 * std::max(one, other);
}

/// Why no reference state has an estimate near.
std::string mismatch(const std::vector<double>& estimate, const std::vector<double>& reference) {
  std::string text = "none of its states is near a state of the estimate in time: it covers " +
                     range_text(reference) + ", the estimate " + range_text(estimate) +
                     "; is it the truth of another recording?";
  if (is_as_long(estimate, reference)) {
    const double shift = reference.front() - estimate.front();
    text += " If it is of this one, " + std::string(shift > 0.0 ? "subtract " : "add ") +
            fixed_number_text(std::round(std::abs(shift) * 1e3) / 1e3) +
            (shift > 0.0 ? " s from" : " s to") +
            " its timestamps: those of .oni recordings count from 0";
  }
  return text;
}

}  // namespace

std::vector<std::string> match_stamps(StatesFile& estimate, StatesFile& reference,
                                      const std::string& name) {
  std::vector<std::string> remarks;
  if (estimate.states.empty() || reference.states.empty()) return remarks;
  const bool estimate_in_seconds = !other_stamp_unit(stamps_in(estimate));
  const bool reference_in_seconds = !other_stamp_unit(stamps_in(reference));
  convert(estimate, "estimate", reference_in_seconds, remarks);
  convert(reference, "reference", estimate_in_seconds, remarks);
  const std::vector<double> estimates = sorted_stamps(estimate);
  const std::vector<double> references = sorted_stamps(reference);
  const double tolerance = half_frame(references);
  if (std::none_of(references.begin(), references.end(), [&](double time) {
        return nearest_stamp(estimates, time, tolerance).has_value();
      })) {
    throw InputError(name, mismatch(estimates, references));
  }
  return remarks;
}

StatesFile at_times_of(const StatesFile& estimate, const StatesFile& reference) {
  constexpr double kMarkedlyFaster = 0.75;  // of the estimate's period: no mere jitter
  const std::vector<double> stamps = stamps_in(reference);
  const double tolerance = half_frame(stamps);
  if (estimate.states.size() < 2 || stamps.size() < 2 ||
      tolerance >= kMarkedlyFaster * half_frame(stamps_in(estimate))) {
    return reference;
  }
  StatesFile result{reference.extra_columns, {}};
  for (const State& state : estimate.states) {
    const auto nearest = nearest_stamp(stamps, state.stamp, tolerance);
    if (!nearest) continue;
    const State& truth = reference.states[*nearest];
    if (result.states.empty() || truth.stamp > result.states.back().stamp) {
      result.states.push_back(truth);
    }
  }
  return result;
}

}  // namespace lockbox
