// SPDX-License-Identifier: BSD-3-Clause
#include "rectification.hpp"

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "camera_plausibility.hpp"
#include "image_limits.hpp"
#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

/// The distorted position of the normalized image point (x, y): the model of ROS and OpenCV.
Eigen::Vector2d distort(double x, double y, const std::vector<double>& coefficients) {
  std::array<double, 8> k{};
  std::copy(coefficients.begin(), coefficients.end(), k.begin());
  const double r2 = x * x + y * y;
  const double radial =
      (1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / (1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
  return {x * radial + 2.0 * k[2] * x * y + k[3] * (r2 + 2.0 * x * x),
          y * radial + k[2] * (r2 + 2.0 * y * y) + 2.0 * k[3] * x * y};
}

/// The same, of a lens that bends angles: k1 to k4.
Eigen::Vector2d distort_angle(double x, double y, const std::vector<double>& k) {
  const double radius = std::hypot(x, y);
  if (radius == 0.0) return {x, y};
  const double angle = std::atan(radius);
  const double a2 = angle * angle;
  const double bent = angle * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
  return {x * bent / radius, y * bent / radius};
}

std::vector<std::ptrdiff_t> undistortion_table(const CameraCalibration& calibration) {
  const PinholeCamera& camera = calibration.camera;
  std::vector<std::ptrdiff_t> table;
  table.reserve(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.back_project(u, v, 1.0);
      const Eigen::Vector2d bent = calibration.is_equidistant
                                       ? distort_angle(ray.x(), ray.y(), calibration.distortion)
                                       : distort(ray.x(), ray.y(), calibration.distortion);
      const Eigen::Vector2d pixel = camera.project({bent.x(), bent.y(), 1.0});
      const bool inside = pixel.x() >= -0.5 && pixel.x() < camera.width - 0.5 &&
                          pixel.y() >= -0.5 && pixel.y() < camera.height - 0.5;
      table.push_back(inside ? std::lround(pixel.y()) * camera.width + std::lround(pixel.x()) : -1);
    }
  }
  return table;
}

}  // namespace

CameraCalibration read_calibration(const std::filesystem::path& file,
                                   const SourceOptions& options) {
  CameraCalibration calibration = read_camera_info(file);
  const std::optional<std::string> doubt = doubtful_principal_point(calibration.camera);
  if (doubt && options.warn) {
    options.warn(file.string() + ": " + *doubt);
  }
  return calibration;
}

std::optional<CameraCalibration> given_calibration(const SourceOptions& options) {
  if (options.camera) {
    return CameraCalibration{.camera = *options.camera, .distortion = {}, .depth_scale = {}};
  }
  if (options.camera_info) {
    return read_calibration(*options.camera_info, options);
  }
  return std::nullopt;
}

Rectification::Rectification(std::optional<CameraCalibration> calibration)
    : calibration_(std::move(calibration)) {
  if (calibration_ && calibration_->has_distortion()) {
    source_of_pixel_ = undistortion_table(*calibration_);
  }
}

void Rectification::check_size(int width, int height, const std::string& where) const {
  if (calibration_ &&
      (calibration_->camera.width != width || calibration_->camera.height != height)) {
    const PinholeCamera& camera = calibration_->camera;
    throw InputError(where, "images are " + size_text(width, height) +
                                " but the camera calibration is for " +
                                size_text(camera.width, camera.height) + "; " +
                                size_advice(camera, width, height));
  }
}

void Rectification::apply(DepthFrame& frame) {
  if (!calibration_) {
    return;
  }
  frame.camera = calibration_->camera;
  if (source_of_pixel_.empty()) {
    return;
  }
  distorted_.swap(frame.depth);
  frame.depth.resize(distorted_.size());
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const std::ptrdiff_t source = source_of_pixel_[i];
    frame.depth[i] = source < 0 ? std::uint16_t{0} : distorted_[static_cast<std::size_t>(source)];
  }
}

}  // namespace lockbox
