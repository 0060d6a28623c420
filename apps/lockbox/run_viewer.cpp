// SPDX-License-Identifier: BSD-3-Clause
#include "run_viewer.hpp"

#include <algorithm>
#include <thread>

#include "interruption.hpp"

namespace lockbox::app {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(5);
constexpr double kLongestPause = 1.0;  // seconds between two frames, however far apart they are

}  // namespace

RunViewer::RunViewer(const ArticulatedModel& model, RecordedRun& run, const Playback& playback,
                     const SceneChoices& choices, const WindowOptions& options)
    : model_(model), run_(run), playback_(playback), choices_(choices), options_(options) {}

void RunViewer::play() {
  const std::string playback_help =
      run_.size() > 1 ? std::string(kPlaybackHelp).append("\n") : std::string();
  SceneComposer composer(model_, playback_help + kSceneHelp);
  const auto window = open_scene_window(composer.parts(), options_);
  const Interruption interruption;
  aim(*window);
  draw(*window, composer);
  while (window->is_open() && !interruption.requested()) {
    bool has_changed = false;
    for (const auto& key : window->poll()) {
      has_changed |= playback_.handle(key) || choices_.handle(key);
    }
    if (playback_.is_playing() && is_next_due()) {
      playback_.advance();
      has_changed = true;
    }
    if (has_changed) {
      draw(*window, composer);
    } else {
      std::this_thread::sleep_for(kPollInterval);
    }
  }
}

RgbImage RunViewer::picture() {
  SceneComposer composer(model_, "");
  WindowOptions options = options_;
  options.visible = false;
  const auto window = open_scene_window(composer.parts(), options);
  aim(*window);
  draw(*window, composer);
  return window->picture();
}

RecordedRun::Moment RunViewer::moment() {
  auto moment = run_.at(playback_.position());
  while (!moment) {  // the recording ends early
    playback_.shorten(run_.size());
    moment = run_.at(playback_.position());
  }
  return *moment;
}

bool RunViewer::is_next_due() const {
  const double stamp = run_.at(playback_.position())->stamp;
  const auto next = run_.at(playback_.position() + 1);
  const double step = next ? std::min(next->stamp - stamp, kLongestPause) : 0.0;
  return std::chrono::duration<double>(Clock::now() - drawn_).count() >= step;
}

void RunViewer::aim(SceneWindow& window) {
  const auto now = moment();
  if (now.frame != nullptr) {
    window.look(camera_near_sensor(*now.frame));
    return;
  }
  for (std::size_t i = playback_.position(); i < run_.size(); ++i) {
    const auto state = run_.at(i);
    if (!state || !state->configuration.T_camera_base.matrix().allFinite()) continue;
    window.look(camera_before_model(model_.tree, state->configuration));
    return;
  }
}

void RunViewer::draw(SceneWindow& window, SceneComposer& composer) {
  const auto now = moment();
  drawn_ = Clock::now();
  window.show(composer.compose(now.frame, now.configuration, title(now), choices_));
}

std::string RunViewer::title(const RecordedRun::Moment& moment) const {
  if (playback_.frames() == 1 && moment.frame == nullptr) return model_.tree.name;
  std::string text = frame_title(playback_.position(), moment.stamp, moment.word);
  if (playback_.is_at_end()) return text + "   end";
  return playback_.is_playing() ? text : text + "   paused";
}

}  // namespace lockbox::app
