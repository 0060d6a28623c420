// SPDX-License-Identifier: BSD-3-Clause
#include "box_turns.hpp"

#include <algorithm>
#include <array>

namespace lockbox {
namespace {

/// A box that differs by more is seen to be another: a quarter of a side is many times what models
/// and sensors err by.
constexpr double kLeastAlike = 0.75;

/// The 24 proper rotations of a cube.
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

constexpr double kSameRotation = 1e-2;

}  // namespace

std::vector<Eigen::Isometry3d> box_turns(const ModelLevers& levers,
                                         std::span<const Eigen::Isometry3d> symmetries) {
  std::vector<Eigen::Isometry3d> turns;
  for (const Eigen::Matrix3d& rotation : cube_rotations()) {
    const Eigen::Array3d turned = (rotation * levers.sides).cwiseAbs();
    const bool is_alike =
        (turned.min(levers.sides.array()) >= kLeastAlike * turned.max(levers.sides.array())).all();
    const bool is_symmetry =
        std::any_of(symmetries.begin(), symmetries.end(), [&](const Eigen::Isometry3d& symmetry) {
          return symmetry.linear().isApprox(rotation, kSameRotation);
        });
    if (!is_alike || is_symmetry) continue;
    Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
    turn.linear() = rotation;
    turn.translation() = levers.centre - rotation * levers.centre;
    turns.push_back(turn);
  }
  return turns;
}

}  // namespace lockbox
