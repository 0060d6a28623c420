// SPDX-License-Identifier: BSD-3-Clause
// Plays .oni recordings through OpenNI2: every frame once, in order, however slow the consumer is.
#pragma once

#include <filesystem>

#include "lockbox/capture/frame_source.hpp"

namespace lockbox {

/// Mirrored recordings are delivered un-mirrored, cropped ones as whole images without measurements
/// outside. Where the resolution changes on the way, so does the camera of the frames; what cannot
/// be told from the file ends the recording early, which is told to options.warn. Intrinsics come
/// from the recorded field of view, with the principal point in the middle, unless options say
/// otherwise.
class OniPlayer : public FrameSource {
 public:
  /// Validates the file first. Throws InputError or DeviceError.
  explicit OniPlayer(const std::filesystem::path& file, const SourceOptions& options = {});
  ~OniPlayer() override;

  bool next(DepthFrame& frame) override;
  std::optional<std::size_t> frame_count() const override;
  std::string file_of_frame() const override;
  /// Returns the file, and the size and rate of its images.
  std::string description() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lockbox
