// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_run.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "lockbox/evaluation/nearest_stamp.hpp"

namespace lockbox::app {
namespace {

/// Where the deviations of the joints stand, as `lockbox track` writes them.
std::vector<std::size_t> find_sigma_columns(const KinematicTree& tree,
                                            const std::vector<std::string>& columns) {
  std::vector<std::size_t> found;
  for (const Joint& joint : tree.joints) {
    const auto column = std::find(columns.begin(), columns.end(), joint.name + ".sigma");
    if (column == columns.end()) return {};
    found.push_back(static_cast<std::size_t>(column - columns.begin()));
  }
  return found;
}

}  // namespace

RecordedRun::RecordedRun(const ArticulatedModel& model, std::optional<RecordedFrames> frames,
                         StatesFile file)
    : model_(model),
      frames_(std::move(frames)),
      states_(std::move(file.states)),
      sigma_columns_(find_sigma_columns(model.tree, file.extra_columns)) {
  for (const auto& state : states_) stamps_.push_back(state.stamp);
}

std::size_t RecordedRun::size() const {
  if (frames_) return frames_->size();
  return states_.empty() ? 1 : states_.size();
}

std::optional<RecordedRun::Moment> RecordedRun::at(std::size_t index) {
  if (!frames_) {
    if (index >= size()) return std::nullopt;
    if (states_.empty()) return start();
    const State& state = states_[index];
    return Moment{nullptr, estimate_of(state), state.stamp, state.status};
  }
  const DepthFrame* const frame = frames_->at(index);
  if (frame == nullptr) return std::nullopt;
  if (const State* const state = state_at(frame->stamp)) {
    return Moment{frame, estimate_of(*state), frame->stamp, state->status};
  }
  return Moment{frame, unknown_configuration(model_.tree), frame->stamp,
                states_.empty() ? "" : "no state"};
}

RecordedRun::Moment RecordedRun::start() const {
  const auto& given = model_.parameters.initial_configuration;
  return {nullptr, given.value_or(rest_configuration(model_.tree)), 0.0, ""};
}

ShownEstimate RecordedRun::estimate_of(const State& state) const {
  ShownEstimate estimate(state.configuration);
  for (const std::size_t column : sigma_columns_) {
    estimate.sigma.push_back(std::strtod(state.extra[column].c_str(), nullptr));
  }
  return estimate;
}

const State* RecordedRun::state_at(double stamp) const {
  if (states_.size() == 1) return &states_.front();
  const auto nearest = nearest_stamp(stamps_, stamp, half_frame(stamps_));
  return nearest ? &states_[*nearest] : nullptr;
}

}  // namespace lockbox::app
