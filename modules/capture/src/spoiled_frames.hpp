// SPDX-License-Identifier: BSD-3-Clause
// Frames of a sequence whose file cannot be used.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace lockbox {

/// They are delivered without any depth, told at the first and at the end, and counted.
class SpoiledFrames {
 public:
  SpoiledFrames(std::string sequence, std::function<void(const std::string&)> warn)
      : sequence_(std::move(sequence)), warn_(std::move(warn)) {}

  /// problem: names the file.
  void add(const std::string& problem);

  /// Tells the count once. It is to be called when all frames were delivered.
  void finish(std::size_t frames);

  std::size_t count() const { return count_; }

 private:
  std::string sequence_;
  std::function<void(const std::string&)> warn_;
  std::size_t count_ = 0;
  bool finished_ = false;
};

/// The first frame of which problem_of tells none. Throws InputError(sequence, ...) if all frames
/// have one, or the first 300 of them: ten seconds, longer than any camera takes to warm up.
std::size_t first_usable_frame(
    const std::string& sequence, std::size_t frames,
    const std::function<std::optional<std::string>(std::size_t)>& problem_of);

}  // namespace lockbox
