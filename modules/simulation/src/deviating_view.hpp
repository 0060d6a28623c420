// SPDX-License-Identifier: BSD-3-Clause
// What a camera that is not quite as calibrated makes of a scene, before any noise.
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/simulation/deviation.hpp"

namespace lockbox::simulation {

class DeviatingView {
 public:
  /// calibration: what the camera is taken for. samples: the same, refined by a whole factor.
  /// Throws InputError if the distortion lets rays cross.
  DeviatingView(const PinholeCamera& calibration, const PinholeCamera& samples,
                const SensorDeviation& deviation, const Executor& executor);

  /// The pinhole whose image measure() takes.
  const PinholeCamera& camera() const { return camera_; }

  /// The depth of each sample as the camera would measure it. scene: seen by camera().
  void measure(const RenderedDepth& scene, RenderedDepth& measured) const;

  /// The rigid motion, in the camera's frame, that takes the surfaces with ids from 0 to below
  /// `ids` nearest to where they seem to be by the calibration: least squares over the samples of
  /// the last scene and what measure() made of it. The identity if none is in view.
  Eigen::Isometry3d apparent_motion(const RenderedDepth& scene, const RenderedDepth& measured,
                                    int ids) const;

 private:
  /// Where a sample lies in the scene's image: a pixel, and how far beside its centre.
  struct Source {
    int u;
    int v;
    double du;
    double dv;
  };

  std::size_t index(int u, int v) const;
  Eigen::Vector2d undistorted(const Eigen::Vector2d& distorted, const Eigen::Vector2d& k) const;
  double depth(const RenderedDepth& scene, const Source& source) const;
  double measured_depth(int u, int v, double z) const;

  PinholeCamera samples_;
  PinholeCamera camera_;
  DepthDeviation depth_;
  Executor executor_;
  std::vector<Source> sources_;
};

}  // namespace lockbox::simulation
