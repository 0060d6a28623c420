// SPDX-License-Identifier: BSD-3-Clause
#include "model_extent.hpp"

#include <algorithm>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/motion_scales.hpp"

namespace lockbox {
namespace {

/// Answers that are nearer to each other are one. Unit: of the model's radius. Source: from there
/// they come to the same rest, unless the view does not tell. Doubled, mugs that are turned by some
/// degrees are one answer.
constexpr double kAnotherAnswer = 0.15;
/// The same of large models. Unit: metres. Source: answers have come to rest; where a frontal view
/// shows of a chest of drawers nothing but fronts, they rest wherever its carcass was put behind
/// them. Doubled, one that was 40 mm too far back is believed.
constexpr double kMostOfOneAnswer = 0.02;

/// Radius from which on models are large. Unit: metres. Source: lengths were chosen by lockboxes
/// and furniture; by 20 mm of slack the table passed for a jaw of pliers that is 12 mm thick.
/// Doubled, joints of furniture are scanned by half of them.
constexpr double kLargeRadius = 0.5;
/// No length is made shorter than this. Unit: metres. Source: prints and woodwork are off by it, as
/// EvidenceOptions::least_model_tolerance. Doubled, thin parts of small things pass for what they
/// lie on.
constexpr double kShortest = 0.0015;

}  // namespace

ModelExtent model_extent(const KinematicTree& tree) {
  Configuration rest = rest_configuration(tree);
  rest.T_camera_base.setIdentity();
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(tree, rest, poses);
  Eigen::AlignedBox3d whole;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    const Eigen::AlignedBox3d box = bounds(tree.bodies[b].mesh);
    if (!box.isEmpty()) whole.extend(box.transformed(poses[b]));
  }
  return {whole.isEmpty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(whole.center()),
          whole.isEmpty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(whole.sizes()),
          whole.isEmpty() ? 1.0 : 0.5 * whole.diagonal().norm(),
          motion_scales(tree).tail(tree.variables())};
}

double least_apart(const ModelExtent& extent) {
  return std::min(kAnotherAnswer * extent.radius, kMostOfOneAnswer);
}

double search_length(const ModelExtent& extent, double metres) {
  const double share = std::min(1.0, extent.radius / kLargeRadius);
  return std::max(share * metres, std::min(metres, kShortest));
}

double farthest_corner(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& from,
                       const Eigen::Isometry3d& to) {
  double farthest = 0.0;
  for (int corner = 0; corner < 8 && !box.isEmpty(); ++corner) {
    const Eigen::Vector3d p = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
    farthest = std::max(farthest, (to * p - from * p).norm());
  }
  return farthest;
}

}  // namespace lockbox
