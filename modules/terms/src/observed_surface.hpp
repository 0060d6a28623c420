// SPDX-License-Identifier: BSD-3-Clause
// What the camera saw around a pixel: where the surface goes on that a sample of the model expects.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/view/view_options.hpp"
#include "lockbox/view/visible_surface.hpp"

namespace lockbox {

class ObservedSurface {
 public:
  /// All of these must outlive the object. T_body_camera: where the bodies are now, which may
  /// differ a little from what the view shows. annealing_sigma: metres that they may be off.
  ObservedSurface(const ArticulatedModel& model, const VisibleSurface& surface,
                  const BodyPoses& T_body_camera, const TiledCloud& cloud,
                  const ViewOptions& options, double annealing_sigma)
      : model_(model),
        surface_(surface),
        T_body_camera_(T_body_camera),
        cloud_(cloud),
        options_(options),
        annealing_sigma_(annealing_sigma) {}

  double sigma_z(double z) const { return options_.noise.sigma_z(z); }
  double sigma_lateral(double z) const {
    return options_.noise.sigma_lateral(z, cloud_.camera().fx);
  }

  /// Whether the measurement lies more than the tolerance behind the expected depth. steepness:
  /// change of the expected depth a pixel, as a share of it; on steep surfaces the lateral noise
  /// reads as depth.
  bool sees_through(const Pixel& pixel, double expected, double steepness) const;

  /// Whether what was measured in the pixel belongs to that body, or to the one that the view shows
  /// there.
  bool shows_object(const Pixel& pixel, int body) const;

  /// The object's observed point nearest to p_camera, in units of the noise, around its pixel, and
  /// less than `farthest` metres away. body: whose point p_camera is.
  std::optional<Eigen::Vector3d> nearest(const Eigen::Vector3d& p_camera, const Pixel& pixel,
                                         int body, double farthest) const;

 private:
  bool inside(int u, int v) const {
    return u >= 0 && v >= 0 && u < cloud_.camera().width && v < cloud_.camera().height;
  }
  double measured(const Pixel& pixel) const {
    const auto width = static_cast<std::size_t>(cloud_.camera().width);
    return static_cast<double>(cloud_.depth()[static_cast<std::size_t>(pixel.v) * width +
                                              static_cast<std::size_t>(pixel.u)]);
  }
  int drawn_body(const Pixel& pixel) const;
  bool belongs_to(int body, const Eigen::Vector3d& p_camera) const;

  const ArticulatedModel& model_;
  const VisibleSurface& surface_;
  const BodyPoses& T_body_camera_;
  const TiledCloud& cloud_;
  const ViewOptions& options_;
  double annealing_sigma_;
};

}  // namespace lockbox
