// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/surface_sigma.hpp"

#include <cmath>

#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

constexpr Eigen::Index kTwist = 6;

/// Deviations of the joint variables; infinite where they are not determined.
Eigen::VectorXd joint_deviations(const KinematicTree& tree, const ShownEstimate& estimate) {
  Eigen::VectorXd deviations = Eigen::VectorXd::Zero(tree.variables());
  for (Eigen::Index v = 0; v < deviations.size() && !estimate.sigma.empty(); ++v) {
    const auto joint = static_cast<std::size_t>(tree.variable_joint[static_cast<std::size_t>(v)]);
    deviations[v] = estimate.sigma[joint];
  }
  return deviations;
}

/// Returns the covariance without what is infinite.
Eigen::MatrixXd finite_covariance(const KinematicTree& tree, const ShownEstimate& estimate,
                                  const Eigen::VectorXd& deviations) {
  const Eigen::Index unknowns = kTwist + tree.variables();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(unknowns, unknowns);
  if (estimate.covariance.rows() == unknowns) {
    covariance = estimate.covariance;
  } else {
    covariance.diagonal().tail(tree.variables()) = deviations.cwiseAbs2();
  }
  for (Eigen::Index v = 0; v < tree.variables(); ++v) {
    if (std::isfinite(deviations[v])) continue;
    covariance.row(kTwist + v).setZero();
    covariance.col(kTwist + v).setZero();
  }
  return covariance.array().isFinite().select(covariance, 0.0);
}

}  // namespace

SurfaceSigma::SurfaceSigma(const KinematicTree& tree,
                           const std::vector<Eigen::Isometry3d>& T_camera_body,
                           const ShownEstimate& estimate) {
  const Eigen::VectorXd deviations = joint_deviations(tree, estimate);
  const Eigen::MatrixXd covariance = finite_covariance(tree, estimate, deviations);
  std::vector<BodyJacobian> jacobians;
  body_jacobians(tree, T_camera_body, jacobians);
  for (const auto& jacobian : jacobians) {
    covariance_.emplace_back(jacobian * covariance * jacobian.transpose());
    bool is_determined = true;
    for (Eigen::Index v = 0; v < deviations.size(); ++v) {
      const bool moves_it = !jacobian.col(kTwist + v).isZero(0.0);
      is_determined = is_determined && (std::isfinite(deviations[v]) || !moves_it);
    }
    is_determined_.push_back(is_determined);
  }
}

float SurfaceSigma::at(std::size_t body, const Eigen::Vector3d& p_body) const {
  if (!is_determined_[body]) return kUndetermined;
  Eigen::Matrix<double, 3, 6> moves;  // the point, for a twist of the body
  moves << Eigen::Matrix3d::Identity(), -hat(p_body);
  const double variance = (moves * covariance_[body] * moves.transpose()).trace();
  return static_cast<float>(std::sqrt(std::max(variance, 0.0)));
}

}  // namespace lockbox
