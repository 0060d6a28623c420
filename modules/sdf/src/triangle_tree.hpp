// SPDX-License-Identifier: BSD-3-Clause
// A bounding volume hierarchy over the triangles of a mesh.
#pragma once

#include <limits>
#include <optional>

#include "lockbox/mesh/triangle_mesh.hpp"
#include "point_triangle.hpp"

namespace lockbox {

/// Immutable; all queries are thread-safe and deterministic.
class TriangleTree {
 public:
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t begin;  ///< range of slots
    std::uint32_t end;
    std::uint32_t right;  ///< second child; 0 for a leaf. The first child follows its parent.
  };

  explicit TriangleTree(const TriangleMesh& mesh);

  /// Parents come before their children; the root is first.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Triangles in the order of the leaves; their places are called slots.
  const std::vector<Corners>& corners() const { return corners_; }
  /// The mesh's number of the triangle in a slot.
  std::uint32_t triangle_of(std::uint32_t slot) const { return triangles_[slot]; }

  /// Distance from p to the nearest triangle, metres, too large by a thousandth at most: where many
  /// triangles are nearly as near, not all are looked at. A known upper bound speeds it up.
  double distance(const Eigen::Vector3d& p,
                  double at_most = std::numeric_limits<double>::infinity()) const;

  /// Exactly, where a triangle is known that is nearly the nearest: that of a point beside p. Its
  /// slot becomes that of the nearest.
  double distance_beside(const Eigen::Vector3d& p, std::uint32_t& slot) const;

  /// Slots of all triangles not farther than radius from p.
  void collect_within(const Eigen::Vector3d& p, double radius,
                      std::vector<std::uint32_t>& slots) const;

  /// Way along the unit direction to the first face that is left through its outside; infinity if
  /// there is none.
  double exit_distance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// How many more faces a ray leaves than it enters; nothing if it runs too close to an edge, or
  /// within a face, to tell.
  std::optional<int> net_exits(const Eigen::Vector3d& origin,
                               const Eigen::Vector3d& direction) const;

 private:
  struct Nearest {
    double squared_distance;  ///< m^2
    std::uint32_t slot;
  };

  /// near_enough: share of the best distance within which others are not worth a look.
  Nearest nearest(const Eigen::Vector3d& p, Nearest best, double near_enough) const;

  /// Calls visit(slot) for all triangles of leaves for whose boxes, and those around them,
  /// is_wanted(box) is true when they are come to.
  template <typename Condition, typename Visitor>
  void for_each_in(Condition&& is_wanted, Visitor&& visit) const;

  void build(const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& centroids,
             std::uint32_t begin, std::uint32_t end);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> triangles_;
  std::vector<Corners> corners_;
};

}  // namespace lockbox
