// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace lockbox {

/// Explains the keys of Playback.
inline constexpr char kPlaybackHelp[] =
    "  space         play, pause\n"
    "  left, right   one frame\n"
    "  down, up      10 frames\n"
    "  page keys     100 frames\n"
    "  home, end     first, last frame\n"
    "  + -           twice, half as fast\n";

/// Where a recording is being looked at, and whether it runs. It does not know the time: whoever
/// shows the frames says when the next one is due.
class Playback {
 public:
  /// frames: at least 1; first < frames.
  Playback(std::size_t frames, std::size_t first, bool playing)
      : frames_(frames), position_(first), playing_(playing) {}

  std::size_t position() const { return position_; }
  std::size_t frames() const { return frames_; }
  bool is_at_end() const { return position_ + 1 == frames_; }

  /// Returns whether it plays. At the end nothing does.
  bool is_playing() const { return playing_ && !is_at_end(); }

  /// What a key stands for (its name in X11); those that step pause. False if it is none of ours.
  bool handle(const std::string& key);

  /// Goes to the frame, or to the last one, and pauses there.
  void seek(std::size_t frame);

  /// How many times as fast as recorded it plays.
  double speed() const { return speed_; }

  /// Goes to the next frame, if there is one.
  void advance();

  /// There turned out to be fewer frames.
  void shorten(std::size_t frames);

 private:
  void toggle();

  std::size_t frames_;
  std::size_t position_;
  bool playing_;
  double speed_ = 1.0;
};

}  // namespace lockbox
