// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_run.hpp"

#include <utility>

#include "lockbox/evaluation/nearest_stamp.hpp"

namespace lockbox::app {

RecordedRun::RecordedRun(const ArticulatedModel& model, std::optional<RecordedFrames> frames,
                         std::vector<State> states)
    : model_(model), frames_(std::move(frames)), states_(std::move(states)) {
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
    return Moment{nullptr, state.configuration, state.stamp, state.status};
  }
  const DepthFrame* const frame = frames_->at(index);
  if (frame == nullptr) return std::nullopt;
  if (const State* const state = state_at(frame->stamp)) {
    return Moment{frame, state->configuration, frame->stamp, state->status};
  }
  return Moment{frame, unknown_configuration(model_.tree), frame->stamp,
                states_.empty() ? "" : "no state"};
}

RecordedRun::Moment RecordedRun::start() const {
  const auto& given = model_.parameters.initial_configuration;
  return {nullptr, given.value_or(rest_configuration(model_.tree)), 0.0, ""};
}

const State* RecordedRun::state_at(double stamp) const {
  if (states_.size() == 1) return &states_.front();
  const auto nearest = nearest_stamp(stamps_, stamp, half_frame(stamps_));
  return nearest ? &states_[*nearest] : nullptr;
}

}  // namespace lockbox::app
