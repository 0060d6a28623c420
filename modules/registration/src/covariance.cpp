// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/covariance.hpp"

#include <Eigen/Eigenvalues>
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

double systematic_floor(const KinematicTree& tree, Index unknown) {
  if (unknown < 6) {
    return unknown < 3 ? kBaseFloor : kBaseTurnFloor;
  }
  const int joint = tree.variable_joint[static_cast<std::size_t>(unknown - 6)];
  return tree.joints[static_cast<std::size_t>(joint)].type == JointType::prismatic ? kSlideFloor
                                                                                   : kTurnFloor;
}

/// Sum over tiles of g g', with g the pull of one tile at all unknowns.
Eigen::MatrixXd tile_scatter(const std::vector<ModelTerm::TileGradient>& tile_gradients,
                             const std::vector<BodyJacobian>& jacobians, Index unknowns) {
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(unknowns);
  for (std::size_t i = 0; i < tile_gradients.size(); ++i) {
    const auto& part = tile_gradients[i];
    pull.noalias() += jacobians[static_cast<std::size_t>(part.body)].transpose() * part.gradient;
    const bool last_of_tile =
        i + 1 == tile_gradients.size() || tile_gradients[i + 1].tile != part.tile;
    if (last_of_tile) {
      scatter.selfadjointView<Eigen::Lower>().rankUpdate(pull);
      pull.setZero();
    }
  }
  return scatter.selfadjointView<Eigen::Lower>();
}

}  // namespace

void estimate_covariance(const KinematicTree& tree, const NormalEquations& data,
                         const std::vector<ModelTerm::TileGradient>& tile_gradients,
                         const std::vector<BodyJacobian>& jacobians, const StepScale& scale,
                         const std::vector<bool>& held, Eigen::MatrixXd& covariance,
                         Eigen::VectorXd& sigma, std::vector<bool>& observable) {
  const Index n = data.gradient.size();
  const Eigen::VectorXd unit = (scale.unit.array() * Eigen::ArrayXd::NullaryExpr(n, [&](Index i) {
                                  return held[static_cast<std::size_t>(i)] ? 0.0 : 1.0;
                                })).matrix();
  const Eigen::MatrixXd scaled = unit.asDiagonal() * data.hessian * unit.asDiagonal();
  // Between the noise that the tiles show and the noise that was assumed: few tiles see a small
  // part.
  const Eigen::MatrixXd scatter = unit.asDiagonal() *
                                  (tile_scatter(tile_gradients, jacobians, n) + data.hessian) *
                                  unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  Eigen::VectorXd inverse(n);
  Eigen::VectorXd unknown_modes(n);
  for (Index k = 0; k < n; ++k) {
    const bool strong = eigen.eigenvalues()[k] > scale.least_information;
    inverse[k] = strong ? 1.0 / eigen.eigenvalues()[k] : 0.0;
    unknown_modes[k] = strong ? 0.0 : 1.0;
  }
  const Eigen::MatrixXd& V = eigen.eigenvectors();
  const Eigen::MatrixXd bread = V * inverse.asDiagonal() * V.transpose();
  covariance = unit.asDiagonal() *
               (bread * scatter * bread + V * unknown_modes.asDiagonal() * V.transpose()) *
               unit.asDiagonal();
  sigma.resize(n);
  observable.assign(static_cast<std::size_t>(n), true);
  for (Index i = 0; i < n; ++i) {
    if (unit[i] == 0.0) {
      sigma[i] = 0.0;
      continue;
    }
    covariance(i, i) += std::pow(systematic_floor(tree, i), 2);
    sigma[i] = std::sqrt(covariance(i, i));
    observable[static_cast<std::size_t>(i)] = sigma[i] < 0.99 * unit[i];
  }
}

}  // namespace lockbox
