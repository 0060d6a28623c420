// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/playback.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace lockbox {
namespace {

constexpr double kSlowest = 1.0 / 16.0;
constexpr double kFastest = 16.0;

}  // namespace

bool Playback::handle(const std::string& key) {
  constexpr auto kAll = std::numeric_limits<std::ptrdiff_t>::max();
  static const std::map<std::string, std::ptrdiff_t> steps = {
      {"Left", -1},    {"Right", 1},  {"Down", -10},   {"Up", 10},
      {"Prior", -100}, {"Next", 100}, {"Home", -kAll}, {"End", kAll}};
  static const std::map<std::string, double> speeds = {
      {"plus", 2.0}, {"equal", 2.0}, {"KP_Add", 2.0}, {"minus", 0.5}, {"KP_Subtract", 0.5}};
  if (key == "space") {
    toggle();
    return true;
  }
  if (const auto change = speeds.find(key); change != speeds.end()) {
    speed_ = std::clamp(speed_ * change->second, kSlowest, kFastest);
    return true;
  }
  const auto step = steps.find(key);
  if (step == steps.end()) return false;
  playing_ = false;
  const auto before = static_cast<std::ptrdiff_t>(position_);
  const auto last = static_cast<std::ptrdiff_t>(frames_ - 1);
  position_ = static_cast<std::size_t>(before + std::clamp(step->second, -before, last - before));
  return true;
}

void Playback::toggle() {
  const bool was_playing = is_playing();
  if (!was_playing && is_at_end()) position_ = 0;  // once more
  playing_ = !was_playing;
}

void Playback::seek(std::size_t frame) {
  playing_ = false;
  position_ = std::min(frame, frames_ - 1);
}

void Playback::advance() {
  if (!is_at_end()) ++position_;
}

void Playback::shorten(std::size_t frames) {
  frames_ = frames;
  position_ = std::min(position_, frames_ - 1);
}

}  // namespace lockbox
