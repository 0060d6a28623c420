// SPDX-License-Identifier: BSD-3-Clause
// The Cramer-Rao bound of a configuration: how exactly an unbiased estimate from one depth frame
// alone can be, given the sensor's noise.
//
// Under lateral jitter, pixel i measures the disparity at a random point around its centre. Its
// mean mu_i, the disparity blurred by the jitter's density w, is a smooth function of the unknowns
// x even at depth edges, and its variance D_i is that of the blur plus those of rounding (whatever
// is independent from pixel to pixel). Disparity noise, correlated over an area of A pixels, is
// represented as constant on square tiles of s x s pixels, s^2 nearest to A, independent between
// tiles, with the variance K = sigma^2 A / s^2 that gives sums over many pixels their true
// variance:
//
//   I = sum over tiles:  G' D^-1 G - (G' D^-1 1) (G' D^-1 1)' / (1/K + 1' D^-1 1),   G = d mu / d x
//
// and the bound is I^-1. Uncorrelated disparity noise is part of D, and K = 0.
//
// dmu/dx comes from one rendering R times finer than the image: a blurred image changes where the
// surface's disparity does, and moves with its image; between two neighbouring samples the one that
// is nearer, which hides the other, moves the edge:
//
//   dmu = sum_samples w dd - sum_neighbours w_between (d_next - d_sample) R flow_of_the_nearer
//
// Pixels that may measure nothing (drop-outs) count by their chance to be measured; that a pixel is
// empty is taken to say nothing. Drop-outs at grazing incidence are left out.
// Cost: one rendering of R^2 as many pixels, and 14 x 14 sums a pixel.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/configuration.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/simulation/sensor_model.hpp"

namespace lockbox {

/// Reusable buffers; not thread-safe.
class DepthInformation {
 public:
  /// The tree is referred to.
  DepthInformation(const KinematicTree& tree, const PinholeCamera& camera,
                   const SensorModel& sensor, const Executor& executor);
  ~DepthInformation();
  DepthInformation(DepthInformation&&) noexcept;
  DepthInformation& operator=(DepthInformation&&) noexcept;

  /// Fisher information about a step (base twist, joint variables), see forward_kinematics.hpp:
  /// (6 + variables) squared. scenery: what stands still around the model, in the camera's frame;
  /// their ids do not matter.
  Eigen::MatrixXd compute(const Configuration& configuration,
                          std::span<const RenderItem> scenery = {});

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

/// Standard deviations from this on (metres, radians) mean that a frame says nothing.
inline constexpr double kNoInformation = 100.0;

/// The square roots of the diagonal of information^-1; infinite from kNoInformation on.
Eigen::VectorXd bound_sigma(const Eigen::MatrixXd& information);

}  // namespace lockbox
