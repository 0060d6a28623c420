// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_run.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "lockbox/evaluation/nearest_stamp.hpp"

namespace lockbox::app {
namespace {

std::optional<std::size_t> find_column(const std::vector<std::string>& columns,
                                       const std::string& name) {
  const auto column = std::find(columns.begin(), columns.end(), name);
  if (column == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(column - columns.begin());
}

/// Where the deviations of the joints stand, as `lockbox track` writes them.
std::vector<std::size_t> find_sigma_columns(const KinematicTree& tree,
                                            const std::vector<std::string>& columns) {
  std::vector<std::size_t> found;
  for (const Joint& joint : tree.joints) {
    const auto column = find_column(columns, joint.name + ".sigma");
    if (!column) return {};
    found.push_back(*column);
  }
  return found;
}

}  // namespace

RecordedRun::RecordedRun(const ArticulatedModel& model, std::optional<RecordedFrames> frames,
                         StatesFile file, std::vector<Eigen::MatrixXd> covariances,
                         AlternativesByStamp alternatives)
    : model_(model),
      frames_(std::move(frames)),
      states_(std::move(file.states)),
      sigma_columns_(find_sigma_columns(model.tree, file.extra_columns)),
      belief_column_(find_column(file.extra_columns, "belief")),
      alternatives_column_(find_column(file.extra_columns, "alternatives")),
      covariances_(std::move(covariances)),
      alternatives_(std::move(alternatives)) {
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
  Moment moment = at_time(frame->stamp);
  moment.frame = frame;
  return moment;
}

RecordedRun::Moment RecordedRun::at_time(double stamp) const {
  if (const State* const state = state_at(stamp)) {
    return {nullptr, estimate_of(*state), stamp, state->status};
  }
  return {nullptr, unknown_configuration(model_.tree), stamp, states_.empty() ? "" : "no state"};
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
  if (belief_column_ && state.known) {
    const auto& alternatives = alternatives_column_ ? state.extra[*alternatives_column_] : "";
    estimate.belief =
        belief_line(std::strtod(state.extra[*belief_column_].c_str(), nullptr), alternatives);
  }
  const auto found = alternatives_.find(state.stamp);
  if (found != alternatives_.end()) estimate.alternatives = found->second;
  const auto row = static_cast<std::size_t>(&state - states_.data());
  if (row < covariances_.size()) estimate.covariance = covariances_[row];
  return estimate;
}

const State* RecordedRun::state_at(double stamp) const {
  if (states_.size() == 1) return &states_.front();
  const auto nearest = nearest_stamp(stamps_, stamp, half_frame(stamps_));
  return nearest ? &states_[*nearest] : nullptr;
}

}  // namespace lockbox::app
