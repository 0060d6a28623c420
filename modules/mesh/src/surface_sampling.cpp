// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/surface_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

/// A body of 40 m^2 with a sample every 2 mm; they take about 150 bytes each, twice as many twice
/// that.
constexpr double kMostSamples = 1e7;

/// Position on the Z-order curve of a point in the unit cube, ten bits an axis.
std::uint32_t morton_code(const Eigen::Vector3d& unit) {
  std::uint32_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto coordinate = static_cast<std::uint32_t>(std::clamp(unit[axis], 0.0, 1.0) * 1023.0);
    for (std::uint32_t bit = 0; bit < 10; ++bit) {
      code |= ((coordinate >> bit) & 1U) << (3 * bit + static_cast<std::uint32_t>(axis));
    }
  }
  return code;
}

/// Numbers of points along the curve through a box; those of one cell by position, so that their
/// order does not matter.
template <typename PositionOf>
std::vector<std::uint32_t> along_space_filling_curve(std::size_t count, Eigen::AlignedBox3d box,
                                                     const PositionOf& position_of) {
  struct Visit {
    std::uint32_t code;
    Eigen::Vector3d position;
    std::uint32_t number;
  };
  const Eigen::Vector3d inverse_size = box.sizes().cwiseMax(1e-12).cwiseInverse();
  std::vector<Visit> visits;
  visits.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p = position_of(i);
    visits.push_back({morton_code((p - box.min()).cwiseProduct(inverse_size)), p, i});
  }
  std::sort(visits.begin(), visits.end(), [](const Visit& a, const Visit& b) {
    return std::tie(a.code, a.position.x(), a.position.y(), a.position.z()) <
           std::tie(b.code, b.position.x(), b.position.y(), b.position.z());
  });
  std::vector<std::uint32_t> numbers;
  numbers.reserve(count);
  for (const Visit& visit : visits) numbers.push_back(visit.number);
  return numbers;
}

/// The i-th point of Roberts' R2 sequence, folded into the triangle.
Eigen::Vector3d low_discrepancy_point(const Corners& corners, std::size_t i) {
  constexpr double kStepU = 0.7548776662466927;
  constexpr double kStepV = 0.5698402909980532;
  const double n = static_cast<double>(i);
  double u = std::fmod(0.5 + n * kStepU, 1.0);
  double v = std::fmod(0.5 + n * kStepV, 1.0);
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  return corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh, double spacing) {
  const double total_area = surface_area(mesh);
  if (!(total_area > 0.0)) {
    return {};
  }
  const double count = std::max(1.0, std::round(total_area / (spacing * spacing)));
  if (!(count <= kMostSamples)) {
    throw InputError("geometry", "a surface of " + fixed_number_text(std::round(total_area)) +
                                     " m^2 is too large to be sampled; lengths are in metres: is "
                                     "the mesh in millimetres?");
  }
  const double step = total_area / count;
  std::vector<SurfaceSample> samples;
  samples.reserve(static_cast<std::size_t>(count));
  double passed_area = 0.0;
  const Eigen::AlignedBox3d box = bounds(mesh);
  const auto centroid = [&](std::uint32_t triangle) -> Eigen::Vector3d {
    const auto [a, b, c] = mesh.corners(triangle);
    return (a + b + c) / 3.0;
  };
  for (const std::uint32_t triangle :
       along_space_filling_curve(mesh.triangles.size(), box, centroid)) {
    const Corners corners = mesh.corners(triangle);
    const Eigen::Vector3d area = area_vector(corners);
    passed_area += area.norm();
    while ((static_cast<double>(samples.size()) + 0.5) * step < passed_area) {
      samples.push_back({low_discrepancy_point(corners, samples.size()), area.normalized(), step});
    }
  }
  std::vector<SurfaceSample> sorted;
  sorted.reserve(samples.size());
  const auto position = [&](std::uint32_t i) { return samples[i].position; };
  for (const std::uint32_t i : along_space_filling_curve(samples.size(), box, position)) {
    sorted.push_back(samples[i]);
  }
  return sorted;
}

}  // namespace lockbox
