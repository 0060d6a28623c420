// SPDX-License-Identifier: BSD-3-Clause
// Brings the frames of any source to an ideal pinhole camera.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lockbox/capture/camera_info.hpp"
#include "lockbox/capture/frame_source.hpp"

namespace lockbox {

/// Reads it, and tells options.warn what is doubtful about it. Throws InputError.
CameraCalibration read_calibration(const std::filesystem::path& file, const SourceOptions& options);

/// The calibration that the user gave, if any: options.camera, else options.camera_info.
std::optional<CameraCalibration> given_calibration(const SourceOptions& options);

/// Replaces the intrinsics of frames by a given calibration and undoes its distortion. Depth along
/// the optical axis does not change under it, so each pixel takes the value of the nearest
/// distorted one: interpolating would invent surfaces between foreground and background.
class Rectification {
 public:
  /// Prepares to rectify frames. Without a calibration, they pass unchanged.
  explicit Rectification(std::optional<CameraCalibration> calibration);

  /// Throws InputError(where, ...) if the image has another size than the calibration.
  void check_size(int width, int height, const std::string& where) const;

  void apply(DepthFrame& frame);

 private:
  std::optional<CameraCalibration> calibration_;
  std::vector<std::ptrdiff_t> source_of_pixel_;  ///< -1: outside the distorted image
  std::vector<std::uint16_t> distorted_;
};

}  // namespace lockbox
