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
  /// explained: by point of the cloud, how much of the outlier cost the model spares it.
  ObservedSurface(const TiledCloud& cloud, const std::vector<float>& explained,
                  const RegistrationOptions& options)
      : cloud_(cloud), explained_(explained), options_(options) {}

  double sigma_z(double z) const { return options_.noise.sigma_z(z); }
  double sigma_lateral(double z) const {
    return options_.noise.sigma_lateral(z, cloud_.camera().fx);
  }

  /// Whether the measurement lies more than the dead zone behind the expected depth. steepness:
  /// change of the expected depth a pixel, as a share of it; on steep surfaces the lateral noise
  /// reads as depth.
  bool sees_through(const Pixel& pixel, double expected, double steepness) const;

  /// Whether what was measured in the pixel is as good as explained by the model.
  bool shows_object(const Pixel& pixel) const;

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
  const std::vector<float>& explained_;
  const RegistrationOptions& options_;
};

}  // namespace lockbox
