// SPDX-License-Identifier: BSD-3-Clause
#include "spoiled_frames.hpp"

#include <algorithm>

#include "lockbox/core/error.hpp"

namespace lockbox {

void SpoiledFrames::add(const std::string& problem) {
  ++count_;
  if (warn_ && count_ == 1) {
    warn_(problem + "; this frame counts as one without any depth, as will others like it");
  }
}

void SpoiledFrames::finish(std::size_t frames) {
  if (warn_ && count_ > 1 && !finished_) {
    warn_(sequence_ + ": " + std::to_string(count_) + " of " + std::to_string(frames) +
          " frames could not be used and counted as frames without any depth");
  }
  finished_ = true;
}

std::size_t first_usable_frame(
    const std::string& sequence, std::size_t frames,
    const std::function<std::optional<std::string>(std::size_t)>& problem_of) {
  constexpr std::size_t kPatience = 300;
  std::string first;
  const std::size_t tried = std::min(frames, kPatience);
  for (std::size_t frame = 0; frame < tried; ++frame) {
    const std::optional<std::string> problem = problem_of(frame);
    if (!problem) {
      return frame;
    }
    if (frame == 0) {
      first = *problem;
    }
  }
  const std::string number = (tried < frames ? "first " : "") + std::to_string(tried) + " frames";
  throw InputError(sequence, frames == 1
                                 ? "its only frame cannot be used: " + first
                                 : "none of its " + number + " can be used; the first: " + first);
}

}  // namespace lockbox
