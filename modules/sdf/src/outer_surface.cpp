// SPDX-License-Identifier: BSD-3-Clause
#include "outer_surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/mesh/topology.hpp"

namespace lockbox {
namespace {

/// How far beside the surface the winding number is asked for, as a share of the diagonal.
constexpr double kStandOff = 2e-5;

struct Bounded {
  std::uint32_t shell;
  Eigen::AlignedBox3d box;
};

std::vector<Bounded> shell_bounds(const TriangleMesh& mesh, const Shells& shells) {
  std::vector<Bounded> boxes(shells.count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t shell = shells.of_triangle[t];
    boxes[shell].shell = shell;
    for (const Eigen::Vector3d& corner : mesh.corners(t)) {
      boxes[shell].box.extend(corner);
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

/// Cuts triangles until each piece is either exposed or buried.
class BuriedRemover {
 public:
  BuriedRemover(const TriangleMesh& mesh, const WindingTree& winding)
      : mesh_(mesh),
        winding_(winding),
        shells_(find_shells(mesh)),
        boxes_(shell_bounds(mesh, shells_)),
        middle_(bounds(mesh).center()),
        diagonal_(bounds(mesh).diagonal().norm()) {}

  OuterSurface run() {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Corners corners = mesh_.corners(t);
      const Eigen::Vector3d normal = area_vector(corners).normalized();
      keep_exposed(corners, normal, others_near(box_of(corners), t));
      for (const Corners& piece : pieces_) {
        add(piece, t);
      }
      pieces_.clear();
    }
    return std::move(surface_);
  }

 private:
  std::vector<Bounded> others_near(const Eigen::AlignedBox3d& box, std::uint32_t triangle) const {
    std::vector<Bounded> others;
    for (const Bounded& shell : boxes_) {
      if (shell.shell != shells_.of_triangle[triangle] && is_near(box, shell.box)) {
        others.push_back(shell);
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
                    const std::vector<Bounded>& others) {
    const Eigen::AlignedBox3d box = box_of(piece);
    if (std::none_of(others.begin(), others.end(),
                     [&](const Bounded& other) { return is_near(box, other.box); })) {
      surface_.volume += volume_below(piece);
      pieces_.push_back(piece);
      return true;
    }
    std::size_t longest = 0;
    const double length = longest_side(piece, longest);
    if (length <= diagonal_ / 128.0) {
      const int exposed = count_exposed(piece, normal);
      const bool is_mixed = exposed > 0 && exposed < kProbes;
      if (!is_mixed || length <= diagonal_ / 1024.0) {
        if (is_exposed((piece[0] + piece[1] + piece[2]) / 3.0, normal)) {
          surface_.volume += volume_below(piece);
        }
        if (exposed > 0) {
          pieces_.push_back(piece);
        }
        return exposed > 0;
      }
    }
    const std::size_t first = pieces_.size();
    const Eigen::Vector3d half = 0.5 * (piece[longest] + piece[(longest + 1) % 3]);
    Corners left = piece;
    Corners right = piece;
    left[(longest + 1) % 3] = half;
    right[longest] = half;
    const bool left_whole = keep_exposed(left, normal, others);
    const bool right_whole = keep_exposed(right, normal, others);
    if (left_whole && right_whole) {
      pieces_.resize(first);
      pieces_.push_back(piece);
    }
    return left_whole && right_whole;
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

  static constexpr int kProbes = 4;

  /// At the middle and just inside the corners.
  int count_exposed(const Corners& piece, const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d middle = (piece[0] + piece[1] + piece[2]) / 3.0;
    int exposed = is_exposed(middle, normal) ? 1 : 0;
    for (const Eigen::Vector3d& corner : piece) {
      exposed += is_exposed(corner + 0.01 * (middle - corner), normal) ? 1 : 0;
    }
    return exposed;
  }

  bool is_exposed(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d offset = kStandOff * diagonal_ * normal;
    return winding_.is_inside(p + offset) != winding_.is_inside(p - offset);
  }

  /// The piece's term of the divergence theorem, m^3.
  double volume_below(const Corners& piece) const {
    return (piece[0] - middle_).dot(area_vector(piece)) / 3.0;
  }

  void add(const Corners& piece, std::uint32_t source) {
    const auto first = static_cast<std::uint32_t>(surface_.mesh.vertices.size());
    surface_.mesh.vertices.insert(surface_.mesh.vertices.end(), piece.begin(), piece.end());
    surface_.mesh.triangles.push_back({first, first + 1, first + 2});
    surface_.source.push_back(source);
  }

  const TriangleMesh& mesh_;
  const WindingTree& winding_;
  Shells shells_;
  std::vector<Bounded> boxes_;
  Eigen::Vector3d middle_;
  double diagonal_;
  std::vector<Corners> pieces_;  ///< of the current triangle
  OuterSurface surface_;
};

}  // namespace

double open_share(const TriangleMesh& mesh, const WindingTree& winding) {
  if (winding.is_closed()) {
    return 0.0;
  }
  constexpr double kSamples = 2000.0;
  const double stand_off = kStandOff * bounds(mesh).diagonal().norm();
  const auto samples = sample_surface(mesh, std::sqrt(surface_area(mesh) / kSamples));
  double sum = 0.0;
  for (const SurfaceSample& sample : samples) {
    const double outside = winding(sample.position + stand_off * sample.normal);
    sum += std::abs(outside - std::round(outside));
  }
  // A hole takes away the solid angle that it is seen under, 2 pi at most of the 4 pi.
  return 2.0 * sum / static_cast<double>(samples.size());
}

OuterSurface find_outer_surface(const TriangleMesh& mesh, const WindingTree& winding) {
  return BuriedRemover(mesh, winding).run();
}

}  // namespace lockbox
