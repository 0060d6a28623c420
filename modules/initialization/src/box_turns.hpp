// SPDX-License-Identifier: BSD-3-Clause
// A model turned to where its contour is nearly the same: back to front, upside down. What is taken
// for one of them may be another, and is compared with all (docs/initialization.md).
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "model_extent.hpp"

namespace lockbox {

/// The 24 proper rotations of a cube.
std::vector<Eigen::Matrix3d> cube_rotations();

/// Whether two boxes of these sides differ by no more than a quarter of each, or by the tolerance;
/// metres.
bool are_alike(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double tolerance);

/// The motions, in the base's frame, that turn the box around the model at rest onto itself, about
/// its middle, up to a quarter of each of its sides; without those after which the model looks the
/// same. symmetries: these, the identity among them.
std::vector<Eigen::Isometry3d> box_turns(const ModelExtent& extent,
                                         std::span<const Eigen::Isometry3d> symmetries);

/// Adds the motions after which the base alone looks the same, but for those that are one of the
/// turns or symmetries: what the base of a lamp tells, it tells of all of them. They turn about the
/// middle of the base, which need not be that of the model.
void add_turns_of_base(const ModelExtent& extent, std::span<const Eigen::Isometry3d> of_base,
                       std::span<const Eigen::Isometry3d> symmetries,
                       std::vector<Eigen::Isometry3d>& turns);

/// Adds turns by a quarter of a right angle about the middle, either way about each axis of the
/// base: something round may rest so far from where it is.
void add_near_turns(const ModelExtent& extent, std::vector<Eigen::Isometry3d>& turns);

}  // namespace lockbox
