// SPDX-License-Identifier: BSD-3-Clause
#include "flat_windows.hpp"

#include <pcl/sample_consensus/msac.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "lockbox/cloud/plane_model.hpp"

namespace lockbox {
namespace {

constexpr std::array<int, 2> kSizes{8, 14};  // samples along each side
constexpr double kLeastMeasured = 0.5;       // share of a window
constexpr double kLeastInliers = 0.6;        // of what is measured
constexpr double kLeastSpread = 0.125;       // share of the window, twice the area of a triangle
constexpr int kTrials = 30;
constexpr int kRefinements = 2;

using Points = pcl::PointCloud<pcl::PointXYZ>;

/// (x/z, y/z, 1/z), in which planes are planes, too, and the noise is the same everywhere.
Points::Ptr ray_coordinates(const InverseDepth& inverse_depth) {
  auto rays = pcl::make_shared<Points>();
  rays->reserve(inverse_depth.size());
  for (std::size_t i = 0; i < inverse_depth.size(); ++i) {
    const Eigen::Vector3f ray = inverse_depth.ray(i);
    rays->push_back({ray.x(), ray.y(), inverse_depth[i]});
  }
  return rays;
}

/// The plane that most of the window's samples lie in.
std::optional<FlatWindow> fit_window(const Points::ConstPtr& rays, const pcl::Indices& window,
                                     const InverseDepth& inverse_depth, float min_spread,
                                     double tolerance) {
  const auto model = pcl::make_shared<PlaneModel>(rays, window, min_spread);
  pcl::MEstimatorSampleConsensus<pcl::PointXYZ> consensus(model, tolerance);
  consensus.setMaxIterations(kTrials);
  if (!consensus.computeModel()) return std::nullopt;
  pcl::Indices inliers;
  consensus.getInliers(inliers);
  FlatWindow flat{{}, 0.0, {}};
  for (int i = 0; i < kRefinements; ++i) {
    flat.samples.assign(inliers.begin(), inliers.end());
    const auto m = inverse_depth.fit_plane(flat.samples);
    if (!m) return std::nullopt;
    flat.m = *m;
    inliers.clear();
    for (const int sample : window) {
      if (static_cast<double>(inverse_depth.residual(*m, static_cast<std::size_t>(sample))) <
          tolerance) {
        inliers.push_back(sample);
      }
    }
  }
  flat.samples.assign(inliers.begin(), inliers.end());
  const auto count = static_cast<double>(inliers.size());
  if (count < kLeastInliers * static_cast<double>(window.size())) return std::nullopt;
  flat.quality = count;
  for (const std::size_t sample : flat.samples) {
    const double off = static_cast<double>(inverse_depth.residual(flat.m, sample)) / tolerance;
    flat.quality -= off * off;
  }
  return flat;
}

struct Window {
  int left;
  int top;
  int size;
};

std::vector<Window> windows_of(const CoarseView& view) {
  std::vector<Window> windows;
  for (const int size : kSizes) {
    for (int top = 0; top + size <= view.camera.height; top += size / 2) {
      for (int left = 0; left + size <= view.camera.width; left += size / 2) {
        windows.push_back({left, top, size});
      }
    }
  }
  return windows;
}

pcl::Indices measured(const CoarseView& view, const InverseDepth& inverse_depth,
                      const Window& window) {
  pcl::Indices samples;
  for (int v = window.top; v < window.top + window.size; ++v) {
    for (int u = window.left; u < window.left + window.size; ++u) {
      const std::size_t sample = view.index(u, v);
      if (inverse_depth[sample] > 0.0F) samples.push_back(static_cast<int>(sample));
    }
  }
  return samples;
}

}  // namespace

// pcl::MEstimatorSampleConsensus, seeded: docs/initialization.md compares it with other segmenters.
std::vector<FlatWindow> find_flat_windows(const CoarseView& view, const InverseDepth& inverse_depth,
                                          double tolerance, const Executor& executor) {
  const Points::ConstPtr rays = ray_coordinates(inverse_depth);
  const std::vector<Window> windows = windows_of(view);
  std::vector<std::optional<FlatWindow>> fits(windows.size());
  executor.for_each(windows.size(), [&](std::size_t i) {
    const pcl::Indices samples = measured(view, inverse_depth, windows[i]);
    const double cells = windows[i].size * windows[i].size;
    if (static_cast<double>(samples.size()) < kLeastMeasured * cells) return;
    const auto spread =
        static_cast<float>(kLeastSpread * cells / (view.camera.fx * view.camera.fy));
    fits[i] = fit_window(rays, samples, inverse_depth, spread, tolerance);
  });
  std::vector<FlatWindow> flat;
  for (auto& fit : fits) {
    if (fit) flat.push_back(std::move(*fit));
  }
  std::stable_sort(flat.begin(), flat.end(),
                   [](const auto& a, const auto& b) { return a.quality > b.quality; });
  return flat;
}

}  // namespace lockbox
