// SPDX-License-Identifier: BSD-3-Clause
#include "triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lockbox {
namespace {

constexpr std::uint32_t kLeafSize = 2;
/// Halving keeps the depth below the number of bits in a triangle's number.
constexpr std::size_t kStackSize = 64;

/// Nodes still to be visited. Left uninitialised: clearing it would cost more than many a query.
class NodeStack {
 public:
  struct Entry {
    std::uint32_t node;
    double squared_distance;
  };

  void push(std::uint32_t node, double squared_distance) {
    entries_[size_++] = {node, squared_distance};
  }
  bool empty() const { return size_ == 0; }
  Entry pop() { return entries_[--size_]; }

 private:
  std::array<Entry, kStackSize> entries_;
  std::size_t size_ = 0;
};

/// Returns the squared distance from p to the box, m^2; Eigen's own is a chain of branches.
double squared_distance(const Eigen::Vector3d& p, const Eigen::AlignedBox3d& box) {
  return (box.min() - p).cwiseMax(p - box.max()).cwiseMax(0.0).squaredNorm();
}

/// Whether the line meets the box, and not only beyond max_way or behind the origin.
bool meets(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin,
           const Eigen::Vector3d& inverse_direction, double max_way) {
  double near = 0.0;
  double far = max_way;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.min()[axis] - origin[axis]) * inverse_direction[axis];
    const double b = (box.max()[axis] - origin[axis]) * inverse_direction[axis];
    // 0 * infinity: the ray runs within the face's plane, which the other axes decide.
    if (!std::isnan(a) && !std::isnan(b)) {
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
  }
  return near <= far;
}

/// Where a ray meets a triangle's plane (Moeller and Trumbore).
struct Crossing {
  double way;     ///< metres along the direction
  double margin;  ///< least barycentric coordinate: negative outside the triangle
  double slope;   ///< cosine between outward normal and direction
};

Crossing cross(const Corners& triangle, const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction) {
  const Eigen::Vector3d ab = triangle[1] - triangle[0];
  const Eigen::Vector3d ac = triangle[2] - triangle[0];
  const Eigen::Vector3d normal = ab.cross(ac);
  const double slope = normal.dot(direction);
  const Eigen::Vector3d offset = triangle[0] - origin;
  const Eigen::Vector3d turned = offset.cross(direction);
  const double v = turned.dot(ac) / slope;
  const double w = -turned.dot(ab) / slope;
  return {normal.dot(offset) / slope, std::min({v, w, 1.0 - v - w}), slope / normal.norm()};
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) : triangles_(mesh.triangles.size()) {
  std::iota(triangles_.begin(), triangles_.end(), 0U);
  std::vector<Eigen::Vector3d> centroids;
  centroids.reserve(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    centroids.emplace_back((a + b + c) / 3.0);
  }
  nodes_.reserve(triangles_.size());
  build(mesh, centroids, 0, static_cast<std::uint32_t>(triangles_.size()));
  corners_.reserve(triangles_.size());
  for (const std::uint32_t triangle : triangles_) {
    corners_.push_back(mesh.corners(triangle));
  }
}

void TriangleTree::build(const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& centroids,
                         std::uint32_t begin, std::uint32_t end) {
  Node node{{}, begin, end, 0};
  Eigen::AlignedBox3d centroid_box;
  for (std::uint32_t slot = begin; slot < end; ++slot) {
    for (const Eigen::Vector3d& corner : mesh.corners(triangles_[slot])) {
      node.box.extend(corner);
    }
    centroid_box.extend(centroids[triangles_[slot]]);
  }
  const std::size_t index = nodes_.size();
  nodes_.push_back(node);
  if (end - begin <= kLeafSize) {
    return;
  }
  Eigen::Index axis = 0;
  centroid_box.sizes().maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle,
                   triangles_.begin() + end, [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(centroids[a][axis], a) < std::pair(centroids[b][axis], b);
                   });
  build(mesh, centroids, begin, middle);
  nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
  build(mesh, centroids, middle, end);
}

double TriangleTree::distance(const Eigen::Vector3d& p, double at_most) const {
  constexpr double kNearEnough = 0.999;
  return std::sqrt(nearest(p, {at_most * at_most, 0}, kNearEnough).squared_distance);
}

double TriangleTree::distance_beside(const Eigen::Vector3d& p, std::uint32_t& slot) const {
  const Nearest found = nearest(p, {squared_distance(p, corners_[slot]), slot}, 1.0);
  slot = found.slot;
  return std::sqrt(found.squared_distance);
}

TriangleTree::Nearest TriangleTree::nearest(const Eigen::Vector3d& p, Nearest best,
                                            double near_enough) const {
  const double share = near_enough * near_enough;
  NodeStack stack;
  stack.push(0, squared_distance(p, nodes_[0].box));
  while (!stack.empty()) {
    const auto [index, box_distance] = stack.pop();
    if (box_distance >= share * best.squared_distance) {
      continue;
    }
    const Node& node = nodes_[index];
    if (node.right == 0) {
      for (std::uint32_t slot = node.begin; slot < node.end; ++slot) {
        const double squared = squared_distance(p, corners_[slot]);
        if (squared < best.squared_distance) best = {squared, slot};
      }
      continue;
    }
    const double left = squared_distance(p, nodes_[index + 1].box);
    const double right = squared_distance(p, nodes_[node.right].box);
    if (left <= right) {
      stack.push(node.right, right);
      stack.push(index + 1, left);
    } else {
      stack.push(index + 1, left);
      stack.push(node.right, right);
    }
  }
  return best;
}

template <typename Condition, typename Visitor>
void TriangleTree::for_each_in(Condition&& is_wanted, Visitor&& visit) const {
  NodeStack stack;
  stack.push(0, 0.0);
  while (!stack.empty()) {
    const std::uint32_t index = stack.pop().node;
    const Node& node = nodes_[index];
    if (!is_wanted(node.box)) {
      continue;
    }
    if (node.right != 0) {
      stack.push(node.right, 0.0);
      stack.push(index + 1, 0.0);
      continue;
    }
    for (std::uint32_t slot = node.begin; slot < node.end; ++slot) {
      visit(slot);
    }
  }
}

void TriangleTree::collect_within(const Eigen::Vector3d& p, double radius,
                                  std::vector<std::uint32_t>& slots) const {
  const double limit = radius * radius;
  for_each_in([&](const Eigen::AlignedBox3d& box) { return squared_distance(p, box) <= limit; },
              [&](std::uint32_t slot) {
                if (squared_distance(p, corners_[slot]) <= limit) slots.push_back(slot);
              });
}

double TriangleTree::exit_distance(const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d inverse = direction.cwiseInverse();
  double best = std::numeric_limits<double>::infinity();
  for_each_in([&](const Eigen::AlignedBox3d& box) { return meets(box, origin, inverse, best); },
              [&](std::uint32_t slot) {
                const Crossing crossing = cross(corners_[slot], origin, direction);
                if (crossing.slope > 0.0 && crossing.margin >= 0.0 && crossing.way > 0.0) {
                  best = std::min(best, crossing.way);
                }
              });
  return best;
}

std::optional<int> TriangleTree::net_exits(const Eigen::Vector3d& origin,
                                           const Eigen::Vector3d& direction) const {
  constexpr double kCloseToEdge = 1e-7;
  constexpr double kGrazing = 1e-5;
  constexpr double kAnyWay = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d inverse = direction.cwiseInverse();
  int exits = 0;
  bool is_certain = true;
  for_each_in(
      [&](const Eigen::AlignedBox3d& box) { return meets(box, origin, inverse, kAnyWay); },
      [&](std::uint32_t slot) {
        const Crossing crossing = cross(corners_[slot], origin, direction);
        if (std::abs(crossing.slope) < kGrazing || std::abs(crossing.margin) < kCloseToEdge) {
          is_certain = false;
        } else if (crossing.margin > 0.0 && crossing.way > 0.0) {
          exits += crossing.slope > 0.0 ? 1 : -1;
        }
      });
  return is_certain ? std::optional<int>(exits) : std::nullopt;
}

}  // namespace lockbox
