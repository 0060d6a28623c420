// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>

#include "lockbox/visualization/rgb_image.hpp"

namespace lockbox::app {

/// A video, which the program ffmpeg encodes. It lasts as long as what it shows took.
class VideoFile {
 public:
  /// All pictures have this size, pixels. The file is replaced. Throws InputError if there is no
  /// ffmpeg.
  VideoFile(const std::filesystem::path& file, int width, int height);

  /// What was written until then stays.
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  /// Stamps are in seconds, and increase. Throws InputError if ffmpeg does not take it.
  void add(const RgbImage& picture, double stamp);

  /// Throws InputError if ffmpeg has failed.
  void finish();

 private:
  void write(const RgbImage& picture);
  int end();

  std::filesystem::path file_;
  pid_t encoder_ = -1;
  int socket_ = -1;  ///< through which it takes pictures
  std::optional<double> start_;
  std::int64_t written_ = 0;  ///< pictures
};

}  // namespace lockbox::app
