// SPDX-License-Identifier: BSD-3-Clause
#include "run_viewer.hpp"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "command_line/interruption.hpp"
#include "lockbox/core/readable_text.hpp"
#include "lockbox/visualization/joint_panel.hpp"

namespace lockbox::app {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(5);
/// Explains what is for a model that is shown alone.
constexpr char kSliderHelp[] = "  sliders       set its joints\n";
constexpr char kPageHelp[] = "  page keys     sliders of its other joints\n";
constexpr double kLongestPause = 1.0;  // seconds between two frames, however far apart they are

}  // namespace

RunViewer::RunViewer(const ArticulatedModel& model, RecordedRun& run, const Playback& playback,
                     const SceneChoices& choices, const WindowOptions& options,
                     std::optional<RunBeside> beside)
    : model_(model),
      run_(run),
      playback_(playback),
      choices_(choices),
      options_(options),
      beside_(std::move(beside)) {}

void RunViewer::play() {
  if (run_.is_model_alone()) posed_ = moment().estimate.configuration;
  Composers composers{{model_, help()}, {model_, ""}};
  const auto window = open_scene_window(composers.run.parts(), options_);
  const Interruption interruption;
  aim(*window);
  draw(*window, composers);
  while (window->is_open() && !interruption.requested()) {
    bool has_changed = false;
    for (const auto& key : window->poll()) has_changed |= handle(key);
    for (const auto& move : window->take_moves()) has_changed |= handle(move);
    if (playback_.is_playing() && is_next_due()) {
      playback_.advance();
      has_changed = true;
    }
    if (has_changed) {
      draw(*window, composers);
    } else {
      std::this_thread::sleep_for(kPollInterval);
    }
  }
}

RgbImage RunViewer::picture() {
  Composers composers{{model_, ""}, {model_, ""}};
  const auto window = open_for_pictures(composers);
  draw(*window, composers);
  return window->picture();
}

void RunViewer::draw_all(const TakePicture& take) {
  Composers composers{{model_, ""}, {model_, ""}};
  const auto window = open_for_pictures(composers);
  const Interruption interruption;
  while (!interruption.requested()) {
    draw(*window, composers);
    take(window->picture(), playback_.position(), moment().stamp);
    if (!run_.at(playback_.position() + 1)) break;
    playback_.advance();
  }
}

std::unique_ptr<SceneWindow> RunViewer::open_for_pictures(const Composers& composers) {
  WindowOptions options = options_;
  options.visible = false;
  auto window = open_scene_window(composers.run.parts(), options);
  aim(*window);
  return window;
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
  return std::chrono::duration<double>(Clock::now() - drawn_).count() >= step / playback_.speed();
}

void RunViewer::aim(SceneWindow& window) {
  const auto now = moment();
  if (now.frame != nullptr) {
    window.look(camera_near_sensor(*now.frame));
    return;
  }
  for (std::size_t i = playback_.position(); i < run_.size(); ++i) {
    const auto state = run_.at(i);
    if (!state || !state->estimate.configuration.T_camera_base.matrix().allFinite()) continue;
    window.look(camera_before_model(model_.tree, state->estimate.configuration));
    return;
  }
}

/// Only what does something.
std::string RunViewer::help() {
  std::string lines = run_.size() > 1 ? kPlaybackHelp : "";
  const std::size_t pages = posed_ ? slider_pages(model_.tree) : 0;
  if (pages > 0) lines += kSliderHelp;
  if (pages > 1) lines += kPageHelp;
  if (moment().frame != nullptr) lines += kPointHelp;
  if (!posed_) lines += kEstimateHelp;
  return lines + kWindowHelp;
}

bool RunViewer::handle(const std::string& key) {
  const std::size_t pages = posed_ ? slider_pages(model_.tree) : 0;
  if (pages > 1 && (key == "Next" || key == "Prior")) {
    slider_page_ = (slider_page_ + (key == "Next" ? 1 : pages - 1)) % pages;
    return true;
  }
  return playback_.handle(key) || choices_.handle(key);
}

bool RunViewer::handle(const SliderMove& move) {
  if (posed_) {
    move_joint(model_.tree, slider_page_, move, *posed_);
    return true;
  }
  const auto frame = static_cast<std::size_t>(std::lround(move.value));
  if (frame == playback_.position()) return false;
  playback_.seek(frame);
  return true;
}

void RunViewer::draw(SceneWindow& window, Composers& composers) {
  auto now = moment();
  drawn_ = Clock::now();
  if (posed_) now.estimate.configuration = *posed_;
  DisplayedScene& scene = composers.run.compose(now.frame, now.estimate, title(now), choices_);
  if (choices_.beside && beside_) {
    const auto other = beside_->run->at_time(now.stamp);
    SceneChoices choices = choices_;
    choices.help = false;
    const std::string name = beside_->name + "   " + other.word;
    add_sliders(now, scene);
    window.show_beside(scene, composers.other.compose(now.frame, other.estimate, name, choices));
  } else if (choices_.beside && now.frame != nullptr) {
    DisplayedScene& measured = composers.other.compose(
        now.frame, unknown_configuration(model_.tree), kMeasuredTitle, choices_.measured_only());
    add_sliders(now, measured);
    window.show_beside(measured, scene);
  } else {
    add_sliders(now, scene);
    window.show(scene);
  }
}

void RunViewer::add_sliders(const RecordedRun::Moment& now, DisplayedScene& scene) const {
  if (posed_ && !choices_.help) {  // which would lie below them
    scene.sliders = joint_sliders(model_.tree, *posed_, slider_page_);
    if (!scene.sliders.empty()) scene.status = title(now);
    const std::string page = slider_page_text(model_.tree, slider_page_);
    if (!page.empty()) scene.status += '\n' + page;
  }
  if (playback_.frames() > 1) {
    scene.seek_bar = {"",
                      "%.0f",
                      0.0,
                      static_cast<double>(playback_.frames() - 1),
                      static_cast<double>(playback_.position()),
                      ""};
  }
}

std::string RunViewer::title(const RecordedRun::Moment& moment) const {
  if (playback_.frames() == 1 && moment.frame == nullptr) return model_.tree.name;
  std::string text = frame_title(playback_.position(), moment.stamp, moment.word);
  if (playback_.speed() != 1.0) text += "   speed " + readable_number(playback_.speed());
  if (playback_.is_at_end()) return text + "   end";
  return playback_.is_playing() ? text : text + "   paused";
}

}  // namespace lockbox::app
