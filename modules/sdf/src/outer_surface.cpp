// SPDX-License-Identifier: BSD-3-Clause
#include "outer_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lockbox/mesh/surface_sampling.hpp"
#include "mesh_parts.hpp"
#include "surplus_volume.hpp"

namespace lockbox {
namespace {

/// How far beside the surface the winding number is asked for, as a share of the diagonal.
constexpr double kStandOff = 2e-5;

/// A part of the mesh near a triangle, which it can bury.
struct Bounded {
  Eigen::AlignedBox3d box;
  double piece;  ///< longest side of the pieces that a triangle within the box is probed by
};

Eigen::AlignedBox3d box_of(const Corners& corners) {
  Eigen::AlignedBox3d box(corners[0]);
  box.extend(corners[1]);
  box.extend(corners[2]);
  return box;
}

/// What is left of some triangles.
struct Exposed {
  std::vector<Corners> pieces;
  std::vector<std::uint32_t> source;  ///< by piece: the triangle
};

/// Cuts triangles until each piece is either exposed or buried.
class BuriedRemover {
 public:
  BuriedRemover(const TriangleMesh& mesh, const WindingTree& winding)
      : mesh_(mesh), winding_(winding), parts_(mesh), diagonal_(bounds(mesh).diagonal().norm()) {}

  /// Cuts the triangles in [begin, end).
  Exposed cut(std::size_t begin, std::size_t end) const {
    Exposed exposed;
    for (std::size_t t = begin; t < end; ++t) {
      const Corners corners = mesh_.corners(t);
      const Eigen::Vector3d normal = area_vector(corners).normalized();
      const auto number = static_cast<std::uint32_t>(t);
      keep_exposed(corners, normal, others_near(box_of(corners), number), exposed);
      exposed.source.resize(exposed.pieces.size(), number);
    }
    return exposed;
  }

 private:
  std::vector<Bounded> others_near(const Eigen::AlignedBox3d& box, std::uint32_t triangle) const {
    std::vector<Bounded> others;
    for (std::uint32_t part = 0; part < parts_.boxes.size(); ++part) {
      const Eigen::AlignedBox3d& part_box = parts_.boxes[part];
      const bool is_other = part != parts_.of_triangle[triangle];
      if ((is_other || part == parts_.open_part()) && !part_box.isEmpty() &&
          is_near(box, part_box)) {
        // What is not closed seldom buries itself: a coarser look must do.
        others.push_back({part_box, diagonal_ / (is_other ? 64.0 : 16.0)});
      }
    }
    return others;
  }

  bool is_near(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) const {
    return a.exteriorDistance(b) <= 2.0 * kStandOff * diagonal_;
  }

  /// Appends the exposed pieces; true if nothing is buried. A piece that is whole replaces its
  /// parts, so that only the border of the buried region is cut finely.
  bool keep_exposed(const Corners& piece, const Eigen::Vector3d& normal,
                    const std::vector<Bounded>& others, Exposed& exposed) const {
    const double probed = probed_length(box_of(piece), others);
    if (std::isinf(probed)) {
      exposed.pieces.push_back(piece);
      return true;
    }
    std::size_t longest = 0;
    const double length = longest_side(piece, longest);
    if (length <= probed) {
      const std::size_t exposed_probes = count_exposed(piece, normal);
      const bool is_mixed = exposed_probes > 0 && exposed_probes < kProbes;
      if (!is_mixed || length <= probed / 4.0) {
        // No piece is dropped while any of it is exposed.
        if (exposed_probes > 0) exposed.pieces.push_back(piece);
        return exposed_probes > 0;
      }
    }
    const std::size_t first = exposed.pieces.size();
    const Eigen::Vector3d half = 0.5 * (piece[longest] + piece[(longest + 1) % 3]);
    Corners left = piece;
    Corners right = piece;
    left[(longest + 1) % 3] = half;
    right[longest] = half;
    const bool left_whole = keep_exposed(left, normal, others, exposed);
    const bool right_whole = keep_exposed(right, normal, others, exposed);
    if (left_whole && right_whole) {
      exposed.pieces.resize(first);
      exposed.pieces.push_back(piece);
    }
    return left_whole && right_whole;
  }

  /// Returns the length of the finest piece of the parts that come near the box; infinity if none
  /// does.
  double probed_length(const Eigen::AlignedBox3d& box, const std::vector<Bounded>& others) const {
    double length = std::numeric_limits<double>::infinity();
    for (const Bounded& other : others) {
      length = is_near(box, other.box) ? std::min(length, other.piece) : length;
    }
    return length;
  }

  static constexpr std::size_t kProbes = 4;

  /// Counts the exposed ones of four points, the middle and some near the corners.
  std::size_t count_exposed(const Corners& piece, const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d middle = (piece[0] + piece[1] + piece[2]) / 3.0;
    std::size_t count = is_exposed(middle, normal) ? 1 : 0;
    for (const Eigen::Vector3d& corner : piece) {
      count += is_exposed(corner + 0.01 * (middle - corner), normal) ? 1 : 0;
    }
    return count;
  }

  static double longest_side(const Corners& piece, std::size_t& longest) {
    double length = 0.0;
    for (std::size_t side = 0; side < 3; ++side) {
      const double candidate = (piece[(side + 1) % 3] - piece[side]).norm();
      if (candidate > length) {
        length = candidate;
        longest = side;
      }
    }
    return length;
  }

  /// Whether one side is inside the solid and the other outside.
  bool is_exposed(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d offset = kStandOff * diagonal_ * normal;
    return winding_.is_inside(p + offset) != winding_.is_inside(p - offset);
  }

  const TriangleMesh& mesh_;
  const WindingTree& winding_;
  MeshParts parts_;
  double diagonal_;
};

void append(const Exposed& exposed, OuterSurface& surface) {
  for (const Corners& piece : exposed.pieces) {
    const auto first = static_cast<std::uint32_t>(surface.mesh.vertices.size());
    surface.mesh.vertices.insert(surface.mesh.vertices.end(), piece.begin(), piece.end());
    surface.mesh.triangles.push_back({first, first + 1, first + 2});
  }
  surface.source.insert(surface.source.end(), exposed.source.begin(), exposed.source.end());
}

}  // namespace

double open_share(const TriangleMesh& mesh, const WindingTree& winding) {
  if (winding.is_closed()) {
    return 0.0;
  }
  constexpr double kSamples = 2000.0;
  constexpr double kPrecise = 12.0;
  const double stand_off = kStandOff * bounds(mesh).diagonal().norm();
  const auto samples = sample_surface(mesh, std::sqrt(surface_area(mesh) / kSamples));
  double sum = 0.0;
  for (const SurfaceSample& sample : samples) {
    const double outside = winding(sample.position + stand_off * sample.normal, kPrecise);
    sum += std::abs(outside - std::round(outside));
  }
  // A hole takes away the solid angle that it is seen under, 2 pi at most of the 4 pi.
  return 2.0 * sum / static_cast<double>(samples.size());
}

OuterSurface find_outer_surface(const TriangleMesh& mesh, const WindingTree& winding,
                                const Executor& executor) {
  constexpr std::size_t kTogether = 64;
  const BuriedRemover remover(mesh, winding);
  const std::size_t triangles = mesh.triangles.size();
  std::vector<Exposed> exposed(chunk_count(triangles, kTogether));
  executor.for_each_chunk(triangles, kTogether,
                          [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                            exposed[chunk] = remover.cut(begin, end);
                          });
  OuterSurface surface;
  surface.volume = signed_volume(mesh) - surplus_volume(mesh, winding, executor);
  for (const Exposed& some : exposed) append(some, surface);
  return surface;
}

}  // namespace lockbox
