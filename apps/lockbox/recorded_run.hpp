// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "alternatives_file.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/states_file.hpp"
#include "lockbox/visualization/scene_composer.hpp"
#include "recorded_frames.hpp"

namespace lockbox::app {

/// Frames of a recording, each with the state that belongs to it; or states alone; or the model as
/// it starts, alone.
class RecordedRun {
 public:
  struct Moment {
    const DepthFrame* frame;  ///< null without a recording
    ShownEstimate estimate;
    double stamp;      ///< seconds
    std::string word;  ///< on the state
  };

  /// file: empty if there is none; a single state holds for all frames. covariances: of its rows,
  /// as far as they are told.
  RecordedRun(const ArticulatedModel& model, std::optional<RecordedFrames> frames, StatesFile file,
              std::vector<Eigen::MatrixXd> covariances = {}, AlternativesByStamp alternatives = {});

  /// Whether there is nothing but the model.
  bool is_model_alone() const { return !frames_ && states_.empty(); }

  std::size_t size() const;

  /// Nothing if the recording turns out to end before. Valid until the next call.
  std::optional<Moment> at(std::size_t index);

  /// The state that belongs to a frame of this time (seconds), without the frame.
  Moment at_time(double stamp) const;

 private:
  Moment start() const;
  const State* state_at(double stamp) const;
  ShownEstimate estimate_of(const State& state) const;

  const ArticulatedModel& model_;
  std::optional<RecordedFrames> frames_;
  std::vector<State> states_;
  std::vector<double> stamps_;              ///< of the states
  std::vector<std::size_t> sigma_columns_;  ///< by joint, of State::extra; empty if one is missing
  std::optional<std::size_t> belief_column_;
  std::optional<std::size_t> alternatives_column_;
  std::vector<Eigen::MatrixXd> covariances_;
  AlternativesByStamp alternatives_;
};

}  // namespace lockbox::app
