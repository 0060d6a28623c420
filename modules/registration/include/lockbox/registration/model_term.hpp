// SPDX-License-Identifier: BSD-3-Clause
// E_model: every observed point under a bounded robust loss of its distance to the body that
// explains it, whitened by the sensor's noise along the field's gradient (docs/mathematics.md).
//
//   E_model(x) = sum_p rho_softmin_l( d_l(T_l^-1 p)^2 / (n' Sigma_p n + spread^2) )
//
// Cost: one field look-up per point and candidate body, whatever the number of joints.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/normal_equations.hpp"
#include "lockbox/registration/registration_options.hpp"

namespace lockbox {

using BodyPoses = std::vector<Eigen::Isometry3d>;  ///< T_camera_body by body

/// Owns the frozen selection of the last linearisation and all scratch memory.
class ModelTerm {
 public:
  /// Selects candidates and variances at these poses, and adds each body's system to systems.
  /// visible: by point of the cloud, the number of the body predicted in its pixel, -1 for none.
  /// spread: how far off the poses may still be, metres. Returns the cost relative to that of
  /// explaining nothing (so it is negative).
  double linearize(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                   const TiledCloud& cloud, const std::vector<float>& visible,
                   const RegistrationOptions& options, double spread, const Executor& executor,
                   std::vector<BodySystem>& systems);

  /// The cost at other poses under the selection of the last linearisation.
  double cost(const ArticulatedModel& model, const BodyPoses& T_camera_body,
              const TiledCloud& cloud, const std::vector<float>& visible, const Executor& executor);

  /// What the last linearisation found of each point of the cloud (its arrays' indices): how much
  /// of the outlier cost c it is spared, 0 .. c.
  const std::vector<float>& explained() const { return explained_; }

  /// How each tile pulls at each body: clusters of residuals for the covariance.
  const std::vector<TileSystem>& tile_systems() const { return tile_systems_; }

  struct Totals {
    double weighted_squares = 0.0;  ///< sum of weight * whitened residual^2
    double points = 0.0;            ///< sum of weights: points that the model explains
  };
  const Totals& totals() const { return totals_; }

 private:
  struct TileCandidates {
    std::size_t tile;
    std::size_t first;  ///< into candidates_ (and slots of kTilePoints in inverse_variance_)
    std::size_t count;
  };
  struct Scratch;

  void select_candidates(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                         const TiledCloud& cloud, const RegistrationOptions& options,
                         double spread);

  kernels::Candidates candidates_of(const TileCandidates& tile, const TiledCloud& cloud,
                                    const std::vector<float>& visible,
                                    const Scratch& scratch) const;

  float cut_ = 0.0F;
  float visible_odds_ = 1.0F;
  std::vector<TileCandidates> tiles_;
  std::vector<int> candidates_;      ///< bodies, tile by tile
  std::vector<float> body_numbers_;  ///< the same, as the kernels compare them
  std::vector<float> inverse_variance_;
  std::vector<float> explained_;
  std::vector<TileSystem> tile_systems_;
  std::vector<double> chunk_costs_;
  std::vector<std::vector<BodySystem>> chunk_systems_;
  std::vector<Totals> chunk_totals_;
  std::vector<std::vector<float>> scratch_;  ///< one block of memory a worker
  Totals totals_;
};

}  // namespace lockbox
