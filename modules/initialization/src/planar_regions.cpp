// SPDX-License-Identifier: BSD-3-Clause
#include "planar_regions.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "flat_windows.hpp"
#include "inverse_depth.hpp"

namespace lockbox {
namespace {

constexpr double kInlier = 2.5;  // standard deviations of a smoothed sample
constexpr int kGrowths = 3;

/// All samples in the plane that hang together with the seeds.
std::vector<std::size_t> grow(const CoarseView& view, const InverseDepth& inverse_depth,
                              const Eigen::Vector3f& m, const std::vector<std::size_t>& seeds,
                              double tolerance) {
  std::vector<std::uint8_t> seen(view.depth.size(), 0);
  std::vector<std::size_t> region;
  const auto visit = [&](std::size_t sample) {
    if (seen[sample] == 0 && inverse_depth[sample] > 0.0F &&
        static_cast<double>(inverse_depth.residual(m, sample)) < tolerance) {
      seen[sample] = 1;
      region.push_back(sample);
    }
  };
  std::for_each(seeds.begin(), seeds.end(), visit);
  const auto width = static_cast<std::size_t>(view.camera.width);
  for (std::size_t next = 0; next < region.size(); ++next) {
    const int u = static_cast<int>(region[next] % width);
    const int v = static_cast<int>(region[next] / width);
    for (const auto& [du, dv] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      if (view.contains(u + du, v + dv)) visit(view.index(u + du, v + dv));
    }
  }
  return region;
}

/// The plane of a window, and all of the view that lies in it and hangs together with the window.
PlanarRegion grown(const CoarseView& view, const InverseDepth& inverse_depth,
                   const FlatWindow& window, double tolerance) {
  PlanarRegion region{window.m, {}};
  for (int growth = 0; growth < kGrowths; ++growth) {
    region.samples = grow(view, inverse_depth, region.m, window.samples, tolerance);
    const auto refined = inverse_depth.fit_plane(region.samples);
    if (!refined) break;
    region.m = *refined;
  }
  return region;
}

}  // namespace

std::vector<PlanarRegion> find_planar_regions(const CoarseView& view, double noise,
                                              std::size_t least_samples, std::size_t most_regions,
                                              const Executor& executor) {
  const InverseDepth inverse_depth(view, noise);
  const double tolerance = kInlier * noise;
  std::vector<std::uint8_t> taken(view.depth.size(), 0);
  std::vector<PlanarRegion> regions;
  for (const FlatWindow& window : find_flat_windows(view, inverse_depth, tolerance, executor)) {
    const auto old = static_cast<std::size_t>(
        std::count_if(window.samples.begin(), window.samples.end(),
                      [&](std::size_t sample) { return taken[sample] != 0; }));
    if (2 * old > window.samples.size()) continue;
    PlanarRegion region = grown(view, inverse_depth, window, tolerance);
    if (region.samples.size() < least_samples) continue;
    for (const std::size_t sample : region.samples) taken[sample] = 1;
    regions.push_back(std::move(region));
  }
  std::stable_sort(regions.begin(), regions.end(), [](const auto& a, const auto& b) {
    return a.samples.size() > b.samples.size();
  });
  if (regions.size() > most_regions) regions.resize(most_regions);
  return regions;
}

Eigen::Isometry3d region_frame(const CoarseView& view, const PlanarRegion& region) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const auto width = static_cast<std::size_t>(view.camera.width);
  for (const std::size_t sample : region.samples) {
    mean += view.point(static_cast<int>(sample % width), static_cast<int>(sample / width))
                .cast<double>();
  }
  mean /= static_cast<double>(region.samples.size());
  const Eigen::Vector3d m = region.m.cast<double>();
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translation() = mean + (1.0 - m.dot(mean)) / m.squaredNorm() * m;
  const Eigen::Vector3d z = -m.normalized();
  const Eigen::Vector3d x = z.unitOrthogonal();
  frame.linear() << x, z.cross(x), z;
  return frame;
}

}  // namespace lockbox
