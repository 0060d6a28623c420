// SPDX-License-Identifier: BSD-3-Clause
// The Cramer-Rao bound of a configuration: how exactly an unbiased estimate from one depth frame
// alone can be, given the sensor's noise.
//
// Under lateral jitter, pixel i measures the disparity at a random point around its centre. Its
// mean mu_i, the disparity blurred by the jitter's density w, is a smooth function of the unknowns
// x even at depth edges, and its variance D_i is that of the blur plus those of rounding (whatever
// is independent from pixel to pixel). On top comes disparity noise n with the correlation R
// between pixels, so that with G = d mu / d x the information and the bound are
//
//   I = G' (D + sigma^2 R)^-1 G,      covariance >= I^-1
//
// dmu/dx comes from one rendering that is finer than the image: a blurred image changes where the
// surface's disparity does, and moves with its image; between two neighbouring samples the one that
// is nearer, which hides the other, moves the edge:
//
//   dmu = sum_samples w dd - sum_neighbours w_between (d_next - d_sample) flow_of_the_nearer
//
// Pixels that may measure nothing (drop-outs) count by their chance to be measured; that a pixel is
// empty is taken to say nothing. Drop-outs at grazing incidence are left out.
// Cost: a rendering of 9 times as many pixels, a few sums over unknowns^2 a pixel, and with
// correlated noise the solution of a sparse system with an unknown in 16 pixels: about half a
// second of one core at 640x480 and 14 unknowns.
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
  /// unknowns x unknowns. scenery: what stands still around the model, in the camera's frame;
  /// their ids do not matter.
  Eigen::MatrixXd compute(const Configuration& configuration,
                          std::span<const RenderItem> scenery = {});

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

/// Standard deviations from this on (metres, radians) mean that a frame says nothing.
inline constexpr double kNoInformation = 100.0;

/// The square roots of the diagonal of information^-1. Infinite from kNoInformation on, and for
/// unknowns that nothing tells apart (correlated by more than 0.99999).
Eigen::VectorXd bound_sigma(const Eigen::MatrixXd& information);

}  // namespace lockbox
