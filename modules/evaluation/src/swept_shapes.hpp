// SPDX-License-Identifier: BSD-3-Clause
// Round shapes: a ring of points that is swept along a way while it changes its size.
#pragma once

#include <span>
#include <vector>

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox::evaluation {

/// An ellipse about its centre, by two of its radii, metres.
struct Ring {
  Eigen::Vector3d centre;
  Eigen::Vector3d x;
  Eigen::Vector3d y;
};

/// The closed surface through the rings, its ends closed by fans around the first and the last
/// centre. Faces point outwards where the rings advance along x cross y.
TriangleMesh swept(const std::vector<Ring>& rings);

/// A surface of revolution about z through these points of (radius, height), metres, from one end
/// of the axis to the other; outside is to the right of the way.
TriangleMesh revolved(std::span<const Eigen::Vector2d> profile);

/// A tube along the points, with round ends.
TriangleMesh tube(const std::vector<Eigen::Vector3d>& points, double radius);

TriangleMesh ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii);

/// Points of an arc about the centre, from `from` over an angle (radians) about the axis.
std::vector<Eigen::Vector3d> arc(const Eigen::Vector3d& centre, const Eigen::Vector3d& from,
                                 const Eigen::Vector3d& axis, double angle);

}  // namespace lockbox::evaluation
