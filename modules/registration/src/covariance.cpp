// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/covariance.hpp"

#include <cmath>
#include <numbers>

namespace lockbox {
namespace {

using Index = Eigen::Index;

// What no amount of data averages away: quantisation, interpolation, the model itself.
constexpr double kBaseFloor = 0.05e-3;                             // metres
constexpr double kBaseTurnFloor = 0.005 * std::numbers::pi / 180;  // radians
constexpr double kSlideFloor = 0.15e-3;                            // metres
constexpr double kTurnFloor = 0.1 * std::numbers::pi / 180;        // radians

constexpr double kObservableShare = 0.1;  // of a unit: where the solver, too, draws the line

double systematic_floor(const KinematicTree& tree, Index unknown) {
  if (unknown < 6) {
    return unknown < 3 ? kBaseFloor : kBaseTurnFloor;
  }
  const int joint = tree.variable_joint[static_cast<std::size_t>(unknown - 6)];
  return tree.joints[static_cast<std::size_t>(joint)].type == JointType::prismatic ? kSlideFloor
                                                                                   : kTurnFloor;
}

}  // namespace

/// scatter_: the sum over tiles of g g', with g the pull of one tile at all unknowns.
void CovarianceEstimator::sum_tiles(const std::vector<ModelTerm::TileGradient>& tile_gradients,
                                    const std::vector<BodyJacobian>& jacobians) {
  for (std::size_t i = 0; i < tile_gradients.size(); ++i) {
    const auto& part = tile_gradients[i];
    pull_.noalias() += jacobians[static_cast<std::size_t>(part.body)].transpose() * part.gradient;
    const bool last_of_tile =
        i + 1 == tile_gradients.size() || tile_gradients[i + 1].tile != part.tile;
    if (last_of_tile) {
      scatter_.noalias() += pull_ * pull_.transpose();
      pull_.setZero();
    }
  }
}

void CovarianceEstimator::estimate(const KinematicTree& tree, const NormalEquations& data,
                                   const std::vector<ModelTerm::TileGradient>& tile_gradients,
                                   double noise_correlation,
                                   const std::vector<BodyJacobian>& jacobians,
                                   const StepScale& scale, const std::vector<bool>& held) {
  const Index n = data.gradient.size();
  unit_ = scale.unit;
  for (Index i = 0; i < n; ++i) {
    if (held[static_cast<std::size_t>(i)]) {
      unit_[i] = 0.0;
    }
  }
  pull_.setZero(n);
  scatter_.setZero(n, n);
  sum_tiles(tile_gradients, jacobians);
  // The noise that the tiles show and the noise that was assumed: few tiles see a small part.
  scatter_ /= noise_correlation * noise_correlation;
  scatter_ += data.hessian;
  scatter_ = unit_.asDiagonal() * scatter_ * unit_.asDiagonal();

  scaled_ = unit_.asDiagonal() * data.information * unit_.asDiagonal();
  modes_.compute(scaled_);
  inverse_.resize(n);
  unknown_modes_.resize(n);
  for (Index k = 0; k < n; ++k) {
    const bool strong = modes_.eigenvalues()[k] > scale.least_information;
    inverse_[k] = strong ? 1.0 / modes_.eigenvalues()[k] : 0.0;
    unknown_modes_[k] = strong ? 0.0 : 1.0;
  }
  const Eigen::MatrixXd& V = modes_.eigenvectors();
  product_.noalias() = V * inverse_.asDiagonal();
  bread_.noalias() = product_ * V.transpose();
  product_.noalias() = bread_ * scatter_;
  covariance_.noalias() = product_ * bread_;
  product_.noalias() = V * unknown_modes_.asDiagonal();
  covariance_.noalias() += product_ * V.transpose();
  covariance_ = unit_.asDiagonal() * covariance_ * unit_.asDiagonal();

  sigma_.setZero(n);
  observable_.assign(static_cast<std::size_t>(n), true);
  for (Index i = 0; i < n; ++i) {
    if (unit_[i] > 0.0) {
      covariance_(i, i) += std::pow(systematic_floor(tree, i), 2);
      sigma_[i] = std::sqrt(covariance_(i, i));
      observable_[static_cast<std::size_t>(i)] = sigma_[i] < kObservableShare * unit_[i];
    }
  }
}

}  // namespace lockbox
