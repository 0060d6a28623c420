// SPDX-License-Identifier: BSD-3-Clause
#include "outer_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/mesh/topology.hpp"

namespace lockbox {
namespace {

/// How far beside the surface the winding number is asked for, as a share of the diagonal.
constexpr double kStandOff = 2e-5;

/// A part of the mesh that can bury another part, or be buried.
struct Bounded {
  std::uint32_t part;
  Eigen::AlignedBox3d box;
  double piece;  ///< longest side of the pieces that a triangle within the box is judged by
};

/// Each closed shell is a part; all that is not closed is one together, for it bounds nothing
/// alone.
Shells find_parts(const TriangleMesh& mesh) {
  Shells parts = find_shells(mesh);
  std::vector<std::uint8_t> is_open(parts.count, 0);
  for_each_edge(sorted_half_edges(mesh), [&](std::span<const HalfEdge> edge) {
    if (edge.size() != 2) {
      for (const HalfEdge& half : edge) {
        is_open[parts.of_triangle[half.triangle]] = 1;
      }
    }
  });
  for (std::uint32_t& part : parts.of_triangle) {
    part = is_open[part] != 0 ? parts.count : part;
  }
  ++parts.count;
  return parts;
}

std::vector<Bounded> part_bounds(const TriangleMesh& mesh, const Shells& parts) {
  std::vector<Bounded> boxes(parts.count);
  for (std::uint32_t part = 0; part < parts.count; ++part) {
    boxes[part] = {part, {}, 0.0};
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const Eigen::Vector3d& corner : mesh.corners(t)) {
      boxes[parts.of_triangle[t]].box.extend(corner);
    }
  }
  return boxes;
}

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
  double overlap = 0.0;               ///< m^3, see Sides::overlap_share()
};

/// The winding number a little outside of a point of the surface, and a little inside.
struct Sides {
  double outside;
  double inside;

  /// By how much it rises from the outside to the inside; 0 where both sides are inside the solid,
  /// or both outside.
  int jump() const {
    const int rise = static_cast<int>(std::lround(inside - outside));
    return (outside > 0.5) == (inside > 0.5) ? 0 : (rise == 0 ? 1 : rise);
  }

  /// The shells' volumes count what lies in several of them several times. That surplus is a body,
  /// too (of a density: its winding number), and this is the share of the face that bounds it. 0 in
  /// a flush contact: there its two faces cancel in the sum of volumes.
  double overlap_share() const {
    const double rise = inside - outside;
    return std::abs(rise) < 0.5 ? 0.0 : (surplus(inside) - surplus(outside)) / rise;
  }

 private:
  static double surplus(double winding) { return winding - (winding > 0.5 ? 1.0 : 0.0); }
};

/// Cuts triangles until each piece is either exposed or buried.
class BuriedRemover {
 public:
  BuriedRemover(const TriangleMesh& mesh, const WindingTree& winding)
      : mesh_(mesh),
        winding_(winding),
        parts_(find_parts(mesh)),
        boxes_(part_bounds(mesh, parts_)),
        middle_(bounds(mesh).center()),
        diagonal_(bounds(mesh).diagonal().norm()) {}

  /// Of the triangles in [begin, end).
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
    const std::uint32_t open_part = parts_.count - 1;
    for (const Bounded& part : boxes_) {
      const bool is_other = part.part != parts_.of_triangle[triangle];
      if ((is_other || part.part == open_part) && !part.box.isEmpty() && is_near(box, part.box)) {
        // What is not closed seldom buries itself: a coarser look must do.
        others.push_back({part.part, part.box, diagonal_ / (is_other ? 64.0 : 16.0)});
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
    const double judged = judged_length(box_of(piece), others);
    if (std::isinf(judged)) {
      exposed.pieces.push_back(piece);
      return true;
    }
    std::size_t longest = 0;
    const double length = longest_side(piece, longest);
    if (length <= judged) {
      const Probes probes = probe(piece, normal);
      const bool is_mixed = std::any_of(probes.begin(), probes.end(), [&](const Sides& sides) {
        return sides.jump() != probes.front().jump() ||
               std::lround(sides.overlap_share()) != std::lround(probes.front().overlap_share());
      });
      if (!is_mixed || length <= judged / 4.0) {
        return keep_judged(piece, probes, exposed);
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

  /// Of the parts that come near the box, the finest piece; infinity if none does.
  double judged_length(const Eigen::AlignedBox3d& box, const std::vector<Bounded>& others) const {
    double length = std::numeric_limits<double>::infinity();
    for (const Bounded& other : others) {
      length = is_near(box, other.box) ? std::min(length, other.piece) : length;
    }
    return length;
  }

  /// Beside four points: the middle, then near the corners.
  using Probes = std::array<Sides, 4>;

  Probes probe(const Corners& piece, const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d middle = (piece[0] + piece[1] + piece[2]) / 3.0;
    Probes probes;
    probes[0] = sides_at(middle, normal);
    for (std::size_t i = 0; i < 3; ++i) {
      probes[i + 1] = sides_at(piece[i] + 0.01 * (middle - piece[i]), normal);
    }
    return probes;
  }

  /// The overlap goes by the middle of a piece, so that errors even out; but no piece is dropped
  /// while any of it is exposed.
  bool keep_judged(const Corners& piece, const Probes& probes, Exposed& exposed) const {
    exposed.overlap += probes.front().overlap_share() * volume_below(piece);
    const bool is_kept = std::any_of(probes.begin(), probes.end(),
                                     [](const Sides& sides) { return sides.jump() != 0; });
    if (is_kept) {
      exposed.pieces.push_back(piece);
    }
    return is_kept;
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

  Sides sides_at(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d offset = kStandOff * diagonal_ * normal;
    return {winding_.counted(p + offset), winding_.counted(p - offset)};
  }

  /// The piece's term of the divergence theorem, m^3.
  double volume_below(const Corners& piece) const {
    return (piece[0] - middle_).dot(area_vector(piece)) / 3.0;
  }

  const TriangleMesh& mesh_;
  const WindingTree& winding_;
  Shells parts_;
  std::vector<Bounded> boxes_;
  Eigen::Vector3d middle_;
  double diagonal_;
};

void append(const Exposed& exposed, OuterSurface& surface) {
  for (const Corners& piece : exposed.pieces) {
    const auto first = static_cast<std::uint32_t>(surface.mesh.vertices.size());
    surface.mesh.vertices.insert(surface.mesh.vertices.end(), piece.begin(), piece.end());
    surface.mesh.triangles.push_back({first, first + 1, first + 2});
  }
  surface.source.insert(surface.source.end(), exposed.source.begin(), exposed.source.end());
  surface.volume -= exposed.overlap;
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
  surface.volume = signed_volume(mesh);
  for (const Exposed& some : exposed) append(some, surface);
  return surface;
}

}  // namespace lockbox
