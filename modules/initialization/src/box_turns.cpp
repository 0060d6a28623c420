// SPDX-License-Identifier: BSD-3-Clause
#include "box_turns.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace lockbox {
namespace {

/// A box that differs by more is seen to be another: a quarter of a side is many times what models
/// and sensors err by.
constexpr double kLeastAlike = 0.75;

bool turns_as_one_of(std::span<const Eigen::Isometry3d> motions, const Eigen::Matrix3d& rotation) {
  /// Of two rotations that count as one: the Frobenius norm of their difference, of that of either;
  /// 0.7 degrees. Source: not recorded. Doubled, a symmetry may be 1.4 degrees off.
  constexpr double kSameRotation = 1e-2;
  return std::any_of(motions.begin(), motions.end(), [&](const Eigen::Isometry3d& motion) {
    return motion.linear().isApprox(rotation, kSameRotation);
  });
}

/// Whether one of the motions turns as that one does, and takes the model's middle to the same
/// place.
bool moves_as_one_of(std::span<const Eigen::Isometry3d> motions, const Eigen::Isometry3d& motion,
                     const ModelExtent& extent) {
  return std::any_of(motions.begin(), motions.end(), [&](const Eigen::Isometry3d& other) {
    const double apart = (other * extent.centre - motion * extent.centre).norm();
    return apart < least_apart(extent) && turns_as_one_of({&other, 1}, motion.linear());
  });
}

Eigen::Isometry3d about_middle(const ModelExtent& extent, const Eigen::Matrix3d& rotation) {
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.linear() = rotation;
  turn.translation() = extent.centre - rotation * extent.centre;
  return turn;
}

}  // namespace

std::vector<Eigen::Matrix3d> cube_rotations() {
  std::vector<Eigen::Matrix3d> rotations;
  std::array<int, 3> axes{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
      for (int i = 0; i < 3; ++i) {
        rotation(i, axes[static_cast<std::size_t>(i)]) = (signs >> i & 1) != 0 ? -1.0 : 1.0;
      }
      if (rotation.determinant() > 0.0) rotations.push_back(rotation);
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return rotations;
}

bool are_alike(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double tolerance) {
  const Eigen::Array3d least = a.array().min(b.array());
  const Eigen::Array3d most = a.array().max(b.array());
  return (least >= kLeastAlike * most || most - least <= tolerance).all();
}

std::vector<Eigen::Isometry3d> box_turns(const ModelExtent& extent,
                                         std::span<const Eigen::Isometry3d> symmetries) {
  std::vector<Eigen::Isometry3d> turns;
  for (const Eigen::Matrix3d& rotation : cube_rotations()) {
    const Eigen::Vector3d turned = (rotation * extent.sides).cwiseAbs();
    if (!are_alike(turned, extent.sides, 0.0) || turns_as_one_of(symmetries, rotation)) continue;
    turns.push_back(about_middle(extent, rotation));
  }
  return turns;
}

void add_turns_of_base(const ModelExtent& extent, std::span<const Eigen::Isometry3d> of_base,
                       std::span<const Eigen::Isometry3d> symmetries,
                       std::vector<Eigen::Isometry3d>& turns) {
  for (const Eigen::Isometry3d& motion : of_base) {
    if (moves_as_one_of(symmetries, motion, extent) || moves_as_one_of(turns, motion, extent))
      continue;
    turns.push_back(motion);
  }
}

void add_near_turns(const ModelExtent& extent, std::vector<Eigen::Isometry3d>& turns) {
  // Source: a tap rested 24 degrees from where it was, as sure as if it were there. Doubled, what
  // rests so near is passed over.
  constexpr double kNearTurn = std::numbers::pi / 8.0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double angle : {-kNearTurn, kNearTurn}) {
      const Eigen::AngleAxisd rotation(angle, Eigen::Vector3d::Unit(axis));
      turns.push_back(about_middle(extent, rotation.toRotationMatrix()));
    }
  }
}

}  // namespace lockbox
