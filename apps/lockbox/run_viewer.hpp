// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lockbox/visualization/playback.hpp"
#include "lockbox/visualization/scene_composer.hpp"
#include "recorded_run.hpp"

namespace lockbox::app {

/// Another run that is shown beside the first, with the same frames.
struct RunBeside {
  const RecordedRun* run;
  std::string name;
};

/// A recorded run in a window.
class RunViewer {
 public:
  /// Model and runs are referred to. The view is chosen for the frame at which playback stands.
  RunViewer(const ArticulatedModel& model, RecordedRun& run, const Playback& playback,
            const SceneChoices& choices, const WindowOptions& options,
            std::optional<RunBeside> beside = std::nullopt);

  /// Plays until the window is closed, or until Ctrl-C. Throws InputError if there is no display.
  void play();

  /// The picture of the frame at which playback stands, without help. Throws InputError if there
  /// is no display.
  RgbImage picture();

  /// What draw_all() gives away.
  using TakePicture = std::function<void(const RgbImage& picture, std::size_t frame, double stamp)>;

  /// The pictures of all frames from the one at which playback stands, until Ctrl-C.
  void draw_all(const TakePicture& take);

 private:
  using Clock = std::chrono::steady_clock;

  RecordedRun::Moment moment();
  bool is_next_due() const;
  void aim(SceneWindow& window);
  bool handle(const std::string& key);
  bool handle(const SliderMove& move);
  std::string help();
  struct Composers {
    SceneComposer run;
    SceneComposer other;  ///< of the other one of two scenes
  };

  std::unique_ptr<SceneWindow> open_for_pictures(const Composers& composers);
  void draw(SceneWindow& window, Composers& composers);
  void add_sliders(const RecordedRun::Moment& now, DisplayedScene& scene) const;
  std::string title(const RecordedRun::Moment& moment) const;

  const ArticulatedModel& model_;
  RecordedRun& run_;
  Playback playback_;
  SceneChoices choices_;
  std::optional<Configuration> posed_;  ///< by the user, a model that is shown alone
  std::size_t slider_page_ = 0;
  WindowOptions options_;
  std::optional<RunBeside> beside_;
  Clock::time_point drawn_;
};

}  // namespace lockbox::app
