// SPDX-License-Identifier: BSD-3-Clause
#include "camera_plausibility.hpp"

#include <algorithm>
#include <cmath>

#include "field_of_view.hpp"
#include "image_limits.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/readable_text.hpp"

namespace lockbox {
namespace {

// Of half the image's width or height: real lenses are mounted within 10 %; doubled, only those of
// a calibration at half or double the resolution are left.
constexpr double kDoubtfulOffset = 0.4;

std::string pair_text(double first, double second) {
  const auto rounded = [](double value) { return std::round(value * 1e3) / 1e3; };
  return "(" + fixed_number_text(rounded(first)) + ", " + fixed_number_text(rounded(second)) + ")";
}

double half_angle_tangent(double field_of_view) {
  return std::tan(field_of_view / 2.0);
}

/// By how much pixels may be wider than high, or higher than wide: sensors that put rows or columns
/// together put four. Doubled, a number with a wrong digit before the point is left in.
constexpr double kMostOblong = 10.0;

std::optional<std::string> oblong(const PinholeCamera& camera) {
  const double factor = camera.fy / camera.fx;
  if (factor >= 1.0 / kMostOblong && factor <= kMostOblong) return std::nullopt;
  return "pixels would be " + readable_number(std::max(factor, 1.0 / factor)) + " times as " +
         (factor > 1.0 ? "wide as high" : "high as wide") + "; is one of the two damaged?";
}

bool is_share(double value) {
  return value > 0.0 && value < 1.0;
}

std::string too_short(const PinholeCamera& camera) {
  if (is_share(camera.cx) && is_share(camera.cy)) {
    return "these are shares of the image's size, and pixels are wanted: multiply fx and cx by "
           "the width, " +
           std::to_string(camera.width) + ", and fy and cy by the height, " +
           std::to_string(camera.height);
  }
  return "it looks like millimetres, and pixels are wanted: divide it by the size of a pixel in "
         "millimetres (0.003 for 3 micrometres)";
}

}  // namespace

std::optional<std::string> impossible_focal_length(const PinholeCamera& camera) {
  const double across = 0.5 * camera.width / camera.fx;
  const double down = 0.5 * camera.height / camera.fy;
  const std::string what = "the focal length " + pair_text(camera.fx, camera.fy) +
                           " is impossible for images of " +
                           size_text(camera.width, camera.height) + ": ";
  if (std::max(across, down) > half_angle_tangent(kMaximumFieldOfView)) {
    return what + too_short(camera);
  }
  if (std::max(across, down) < half_angle_tangent(kMinimumFieldOfView)) {
    return what +
           "it looks like micrometres, and pixels are wanted: divide it by the size of a pixel in "
           "micrometres; or are width and height those of other images?";
  }
  if (const auto shape = oblong(camera)) return what + *shape;
  return std::nullopt;
}

std::optional<std::string> impossible_principal_point(const PinholeCamera& camera) {
  const double across = std::max(camera.cx, camera.width - 1 - camera.cx) / camera.fx;
  const double down = std::max(camera.cy, camera.height - 1 - camera.cy) / camera.fy;
  if (std::max(across, down) <= half_angle_tangent(kMaximumFieldOfView)) return std::nullopt;
  return "the principal point " + pair_text(camera.cx, camera.cy) +
         " is impossible for images of " + size_text(camera.width, camera.height) +
         ", also of those that are cut out of larger ones: no camera sees so far to the side; give "
         "cx and cy of the matrix in pixels, as the calibration has them";
}

std::optional<std::string> doubtful_principal_point(const PinholeCamera& camera) {
  const double across = camera.cx / (0.5 * std::max(1, camera.width - 1));
  const double down = camera.cy / (0.5 * std::max(1, camera.height - 1));
  if (std::abs(across - 1.0) <= kDoubtfulOffset && std::abs(down - 1.0) <= kDoubtfulOffset) {
    return std::nullopt;
  }
  std::string text = "the principal point " + pair_text(camera.cx, camera.cy) +
                     " is far from the middle of images of " +
                     size_text(camera.width, camera.height);
  const double ratio = 0.5 * (across + down);
  if (ratio > 0.0 && std::abs(across - down) < 0.2 * ratio) {
    const double factor = ratio > 1.0 ? 1.0 / std::round(ratio) : std::round(1.0 / ratio);
    return text + "; if the matrix is for another resolution, multiply fx, fy, cx and cy by " +
           fixed_number_text(std::round(factor * 1e3) / 1e3);
  }
  return text + "; unless they are cut out of larger ones, the calibration is wrong";
}

std::string size_advice(const PinholeCamera& camera, int width, int height) {
  if (camera.width == height && camera.height == width) {
    return "width and height are exchanged in the calibration, or the images are turned";
  }
  const double across = static_cast<double>(width) / camera.width;
  const double down = static_cast<double>(height) / camera.height;
  std::string text = "give the calibration of this camera at this resolution";
  if (std::abs(across - down) < 0.01 * across) {
    text += " (if these images are the same view scaled: multiply its size, fx, fy, cx and cy by " +
            fixed_number_text(std::round(across * 1e4) / 1e4) + ")";
  }
  return text;
}

}  // namespace lockbox
