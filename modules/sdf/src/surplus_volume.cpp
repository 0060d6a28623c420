// SPDX-License-Identifier: BSD-3-Clause
#include "surplus_volume.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh_parts.hpp"

namespace lockbox {
namespace {

/// In all boxes together, in proportion to their volumes. The error falls nearly with the number.
constexpr double kSamplesOfAllBoxes = 32768.0;
constexpr double kLeastSamples = 256.0;

/// Outside of these, no point lies in several parts. Beyond a number of boxes, that of the mesh:
/// each sample looks at all.
std::vector<Eigen::AlignedBox3d> overlap_boxes(const TriangleMesh& mesh) {
  constexpr std::size_t kMostBoxes = 1000;
  const MeshParts parts(mesh);
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::size_t a = 0; a < parts.boxes.size(); ++a) {
    // What is not closed may overlap itself.
    for (std::size_t b = a == parts.open_part() ? a : a + 1; b < parts.boxes.size(); ++b) {
      const Eigen::AlignedBox3d box = parts.boxes[a].intersection(parts.boxes[b]);
      if (!box.isEmpty() && box.volume() > 0.0) boxes.push_back(box);
      if (boxes.size() > kMostBoxes) return {bounds(mesh)};
    }
  }
  return boxes;
}

/// The i-th point of Roberts' R3 sequence.
Eigen::Vector3d low_discrepancy_point(const Eigen::AlignedBox3d& box, std::size_t i) {
  const Eigen::Array3d steps(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
  const Eigen::Array3d way = 0.5 + static_cast<double>(i) * steps;
  return box.min() + ((way - way.floor()) * box.sizes().array()).matrix();
}

/// How often the point counts in the sum of volumes, too often.
double surplus_at(const Eigen::Vector3d& p, const WindingTree& winding) {
  const double count = std::round(winding.counted(p));
  return count - (count > 0.0 ? 1.0 : 0.0);
}

}  // namespace

double surplus_volume(const TriangleMesh& mesh, const WindingTree& winding,
                      const Executor& executor) {
  constexpr std::size_t kTogether = 256;
  const std::vector<Eigen::AlignedBox3d> boxes = overlap_boxes(mesh);
  const double volume_of_all =
      std::accumulate(boxes.begin(), boxes.end(), 0.0,
                      [](double sum, const auto& box) { return sum + box.volume(); });
  double surplus = 0.0;
  for (const Eigen::AlignedBox3d& box : boxes) {
    const auto samples = static_cast<std::size_t>(
        std::max(kLeastSamples, std::round(kSamplesOfAllBoxes * box.volume() / volume_of_all)));
    std::vector<double> sums(chunk_count(samples, kTogether), 0.0);
    executor.for_each_chunk(
        samples, kTogether, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
          for (std::size_t i = begin; i < end; ++i) {
            const Eigen::Vector3d p = low_discrepancy_point(box, i);
            const double excess = surplus_at(p, winding);
            if (excess == 0.0) continue;
            // A point in several boxes is met in each of them.
            const auto meetings = std::count_if(
                boxes.begin(), boxes.end(), [&](const auto& other) { return other.contains(p); });
            sums[chunk] += excess / static_cast<double>(std::max<std::ptrdiff_t>(meetings, 1));
          }
        });
    const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    surplus += sum / static_cast<double>(samples) * box.volume();
  }
  return surplus;
}

}  // namespace lockbox
