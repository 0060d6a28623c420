// SPDX-License-Identifier: BSD-3-Clause
// What the camera saw around a pixel: where the surface goes on that a sample of the model expects.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/registration/registration_options.hpp"

namespace lockbox {

class ObservedSurface {
 public:
  /// object: the pixels that show the object (one byte a pixel).
  ObservedSurface(const TiledCloud& cloud, const std::vector<std::uint8_t>& object,
                  const RegistrationOptions& options)
      : cloud_(cloud), object_(object), options_(options) {}

  double sigma_z(double z) const {
    return options_.noise.depth_floor + options_.noise.depth_quadratic * z * z;
  }
  double sigma_lateral(double z) const {
    return options_.noise.lateral_pixels / cloud_.camera().fx * z;
  }

  /// Whether the measurement lies more than the dead zone behind the expected depth. steepness:
  /// change of the expected depth a pixel, as a share of it; on steep surfaces the lateral noise
  /// reads as depth.
  bool sees_through(const Pixel& pixel, double expected, double steepness) const;

  bool shows_object(const Pixel& pixel) const { return object_[index(pixel.u, pixel.v)] != 0; }

  /// The object's observed point nearest to p_camera, in units of the noise, around its pixel.
  std::optional<Eigen::Vector3d> nearest(const Eigen::Vector3d& p_camera, const Pixel& pixel) const;

 private:
  bool inside(int u, int v) const {
    return u >= 0 && v >= 0 && u < cloud_.camera().width && v < cloud_.camera().height;
  }
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(cloud_.camera().width) +
           static_cast<std::size_t>(u);
  }

  const TiledCloud& cloud_;
  const std::vector<std::uint8_t>& object_;
  const RegistrationOptions& options_;
};

}  // namespace lockbox
