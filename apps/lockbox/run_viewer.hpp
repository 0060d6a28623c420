// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "lockbox/visualization/playback.hpp"
#include "lockbox/visualization/scene_composer.hpp"
#include "recorded_run.hpp"

namespace lockbox::app {

/// A recorded run in a window.
class RunViewer {
 public:
  /// Model and run are referred to. The view is chosen for the frame at which playback stands.
  RunViewer(const ArticulatedModel& model, RecordedRun& run, const Playback& playback,
            const SceneChoices& choices, const WindowOptions& options);

  /// Plays until the window is closed, or until Ctrl-C. Throws InputError if there is no display.
  void play();

  /// The picture of the frame at which playback stands, without help. Throws InputError if there
  /// is no display.
  RgbImage picture();

 private:
  using Clock = std::chrono::steady_clock;

  RecordedRun::Moment moment();
  bool is_next_due() const;
  void aim(SceneWindow& window);
  bool handle(const SliderMove& move);
  void draw(SceneWindow& window, SceneComposer& composer);
  std::string title(const RecordedRun::Moment& moment) const;

  const ArticulatedModel& model_;
  RecordedRun& run_;
  Playback playback_;
  SceneChoices choices_;
  std::optional<Configuration> posed_;  ///< by the user, a model that is shown alone
  WindowOptions options_;
  Clock::time_point drawn_;
};

}  // namespace lockbox::app
