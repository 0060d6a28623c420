// SPDX-License-Identifier: BSD-3-Clause
// How sure the estimate is: the sandwich H^-1 S H^-1 (White 1980), with S summed over image tiles
// (cluster-robust, Liang and Zeger 1986), so that noise which neighbouring pixels share counts as
// what it is, and a systematic floor.
#pragma once

#include <Eigen/Eigenvalues>
#include <vector>

#include "lockbox/registration/bounded_step.hpp"
#include "lockbox/registration/model_term.hpp"

namespace lockbox {

/// Owns its memory: once used, it allocates nothing for the same number of unknowns.
class CovarianceEstimator {
 public:
  /// data: the data terms linearised at the solution, divided by noise_correlation. Directions
  /// with too little information are unknown by a whole unit; unknowns held have sigma 0.
  void estimate(const KinematicTree& tree, const NormalEquations& data,
                const std::vector<ModelTerm::TileGradient>& tile_gradients,
                double noise_correlation, const std::vector<BodyJacobian>& jacobians,
                const StepScale& scale, const std::vector<bool>& held);

  /// Of (base twist, variables).
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  /// Square roots of its diagonal.
  const Eigen::VectorXd& sigma() const { return sigma_; }
  /// By unknown: whether sigma is less than a tenth of a unit.
  const std::vector<bool>& observable() const { return observable_; }

 private:
  void sum_tiles(const std::vector<ModelTerm::TileGradient>& tile_gradients,
                 const std::vector<BodyJacobian>& jacobians);

  Eigen::MatrixXd covariance_;
  Eigen::VectorXd sigma_;
  std::vector<bool> observable_;

  Eigen::VectorXd unit_;
  Eigen::VectorXd pull_;
  Eigen::MatrixXd scatter_;
  Eigen::MatrixXd scaled_;
  Eigen::MatrixXd bread_;
  Eigen::MatrixXd product_;
  Eigen::VectorXd inverse_;
  Eigen::VectorXd unknown_modes_;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes_;
};

}  // namespace lockbox
