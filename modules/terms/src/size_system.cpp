// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/size_system.hpp"

#include <cmath>

namespace lockbox {
namespace {

using Index = Eigen::Index;

constexpr Index kTwist = 6;          // unknowns of a body
constexpr double kSideDepth = 0.01;  // metres between sides with one direction; doubled: steps of 1
                                     // to 2 cm count as one side, which tells nothing of relief

/// One of the 26 directions to the neighbours of a cube: what lies within 23 degrees errs together.
int sector_of(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d scaled = direction / direction.cwiseAbs().maxCoeff();
  int sector = 0;
  for (Index axis = 0; axis < 3; ++axis) {
    sector = 3 * sector + 1 + static_cast<int>(std::lround(scaled[axis]));
  }
  return sector;
}

/// How a step moves a body's own unknowns: rows of a row, columns of a step.
Eigen::MatrixXd extended(const BodyJacobian& jacobian) {
  const Index unknowns = jacobian.cols();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(kTwist + kSizeUnknowns, unknowns + kSizeUnknowns);
  result.topLeftCorner(kTwist, unknowns) = jacobian;
  result.bottomRightCorner(kSizeUnknowns, kSizeUnknowns).setIdentity();
  return result;
}

}  // namespace

SizeRow size_row(const Eigen::Isometry3d& T_camera_body, const Eigen::Vector3d& base,
                 const Eigen::Vector3d& point, const Eigen::Vector3d& direction, double pixel) {
  const Eigen::Vector3d n = T_camera_body.linear().transpose() * direction;
  const Eigen::Vector3d p = T_camera_body.inverse() * point;
  const Eigen::Vector3d from_base = point - base;
  SizeRow row;
  row << n, p.cross(n), direction.head<2>().dot(from_base.head<2>()), direction.z() * from_base.z(),
      pixel;
  return row;
}

Eigen::Vector3d size_motion(const Eigen::Vector3d& base, const Eigen::Vector3d& point,
                            double across, double along) {
  return (point - base).cwiseProduct(Eigen::Vector3d(across, across, along));
}

void SizeSystem::set_zero(std::size_t bodies) {
  bodies_.assign(bodies, OfBody());
  sides_.clear();
}

void SizeSystem::add(const Side& side, const SizeRow& row, double residual, double weight) {
  OfBody& body = bodies_[static_cast<std::size_t>(side.body)];
  const SizeRow weighted = weight * row;
  body.hessian.noalias() += weighted * row.transpose();
  body.gradient.noalias() += residual * weighted;
  Sums& sums = sides_[{side.body, side.is_contour, sector_of(side.direction),
                       static_cast<int>(std::lround(side.offset / kSideDepth))}];
  sums.weight += weight;
  sums.row += weighted;
  sums.residual += weight * residual;
}

void SizeSystem::add_to(const std::vector<BodyJacobian>& jacobians, double off,
                        Eigen::MatrixXd& hessian, Eigen::VectorXd& gradient) const {
  std::vector<OfBody> bodies = bodies_;
  for (const auto& [key, sums] : sides_) {
    OfBody& body = bodies[static_cast<std::size_t>(std::get<0>(key))];
    const SizeRow gain = sums.row / (sums.weight + 1.0 / (off * off));
    body.hessian.noalias() -= gain * sums.row.transpose();
    body.gradient.noalias() -= sums.residual * gain;
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Eigen::MatrixXd of_step = extended(jacobians[b]);
    hessian.noalias() += of_step.transpose() * bodies[b].hessian * of_step;
    gradient.noalias() += of_step.transpose() * bodies[b].gradient;
  }
}

}  // namespace lockbox
