// SPDX-License-Identifier: BSD-3-Clause
#include "planar_regions.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace lockbox {
namespace {

constexpr std::array<int, 2> kWindows{8, 14};  // samples along each side of a first guess
constexpr double kInlier = 2.5;                // standard deviations of a smoothed sample
constexpr double kLeastInliers = 0.6;          // share of a window
/// Standard deviations of a sample's 1/depth by which the mean of two opposite neighbours may
/// differ from it, to be averaged with it. Source: not recorded. Doubled, edges twice as high are
/// blurred.
constexpr double kSmooth = 4.0;
/// Share of a window's samples that each trim keeps, at least. Source: not recorded.
constexpr double kLeastKept = 0.7;
/// Rounds that leave out a window's farthest samples, and that let a region grow and fit its plane
/// anew. Source: not recorded. Doubled, smaller planes of a window are found, and each takes
/// longer.
constexpr int kTrims = 3;
constexpr int kGrowths = 3;

/// 1/depth in rays; neighbours that continue a sample smoothly are averaged with it.
class InverseDepth {
 public:
  InverseDepth(const CoarseView& view, double noise)
      : view_(view), values_(view.depth.size(), 0.0F) {
    const auto jump = static_cast<float>(kSmooth * noise);
    for (int v = 0; v < view.camera.height; ++v) {
      for (int u = 0; u < view.camera.width; ++u) {
        values_[view.index(u, v)] = smoothed(u, v, jump);
      }
    }
  }
  /// 0 where nothing is known.
  float operator[](std::size_t sample) const { return values_[sample]; }
  Eigen::Vector3f ray(std::size_t sample) const {
    const auto width = static_cast<std::size_t>(view_.camera.width);
    const std::size_t u = sample % width;
    const std::size_t v = sample / width;
    return view_.camera.back_project(static_cast<double>(u), static_cast<double>(v), 1.0)
        .cast<float>();
  }
  float residual(const Eigen::Vector3f& m, std::size_t sample) const {
    return std::abs(values_[sample] - m.dot(ray(sample)));
  }

 private:
  /// Means of opposite neighbours do not bend a slope.
  float smoothed(int u, int v, float jump) const {
    const float here = view_.depth[view_.index(u, v)];
    if (!(here > 0.0F)) return 0.0F;
    const float centre = 1.0F / here;
    float sum = centre;
    float count = 1.0F;
    // (du, dv) to one of two opposite neighbours.
    constexpr std::array<std::array<int, 2>, 4> kPairs{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
    for (const auto& [du, dv] : kPairs) {
      if (!view_.contains(u + du, v + dv) || !view_.contains(u - du, v - dv)) continue;
      const float a = view_.depth[view_.index(u + du, v + dv)];
      const float b = view_.depth[view_.index(u - du, v - dv)];
      if (!(a > 0.0F && b > 0.0F)) continue;
      const float pair = 1.0F / a + 1.0F / b;
      const float mean = 0.5F * pair;
      if (std::abs(mean - centre) < jump) {
        sum += pair;
        count += 2.0F;
      }
    }
    return sum / count;
  }

  const CoarseView& view_;
  std::vector<float> values_;
};

std::optional<Eigen::Vector3f> fit(const InverseDepth& inverse_depth,
                                   const std::vector<std::size_t>& samples) {
  if (samples.size() < 6) return std::nullopt;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const std::size_t sample : samples) {
    const Eigen::Vector3d ray = inverse_depth.ray(sample).cast<double>();
    moments += ray * ray.transpose();
    right += static_cast<double>(inverse_depth[sample]) * ray;
  }
  const Eigen::Vector3d m = moments.ldlt().solve(right);
  // 1 / metre: a plane a kilometre away, which is none.
  if (!m.allFinite() || !(m.norm() > 1e-3)) return std::nullopt;
  return m.cast<float>();
}

struct Window {
  Eigen::Vector3f m;
  double quality;
  std::vector<std::size_t> inliers;
};

/// The plane that most of the window's samples lie in, outliers trimmed.
std::optional<Window> fit_window(const InverseDepth& inverse_depth,
                                 std::vector<std::size_t> samples, double tolerance) {
  const std::size_t all = samples.size();
  auto m = fit(inverse_depth, samples);
  for (int trim = 0; trim < kTrims && m; ++trim) {
    std::vector<float> residuals(samples.size());
    std::transform(samples.begin(), samples.end(), residuals.begin(),
                   [&](std::size_t s) { return inverse_depth.residual(*m, s); });
    std::vector<float> sorted = residuals;
    const auto keep = static_cast<std::ptrdiff_t>(kLeastKept * static_cast<double>(sorted.size()));
    std::nth_element(sorted.begin(), sorted.begin() + keep, sorted.end());
    const float limit =
        std::max(sorted[static_cast<std::size_t>(keep)], static_cast<float>(tolerance));
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (residuals[i] <= limit) kept.push_back(samples[i]);
    }
    m = fit(inverse_depth, kept);
    samples = std::move(kept);
  }
  if (!m) return std::nullopt;
  Window window{*m, 0.0, {}};
  double squares = 0.0;
  for (const std::size_t sample : samples) {
    const auto residual = static_cast<double>(inverse_depth.residual(*m, sample));
    if (residual < tolerance) {
      window.inliers.push_back(sample);
      squares += residual * residual;
    }
  }
  const auto inliers = static_cast<double>(window.inliers.size());
  if (inliers < kLeastInliers * static_cast<double>(all)) return std::nullopt;
  window.quality = inliers - squares / (tolerance * tolerance);
  return window;
}

std::vector<Window> fit_windows(const CoarseView& view, const InverseDepth& inverse_depth,
                                double tolerance) {
  std::vector<Window> windows;
  for (const int size : kWindows) {
    for (int v0 = 0; v0 + size <= view.camera.height; v0 += size / 2) {
      for (int u0 = 0; u0 + size <= view.camera.width; u0 += size / 2) {
        std::vector<std::size_t> samples;
        for (int v = v0; v < v0 + size; ++v) {
          for (int u = u0; u < u0 + size; ++u) {
            if (inverse_depth[view.index(u, v)] > 0.0F) samples.push_back(view.index(u, v));
          }
        }
        if (2 * samples.size() < static_cast<std::size_t>(size * size)) continue;
        if (auto window = fit_window(inverse_depth, std::move(samples), tolerance)) {
          windows.push_back(std::move(*window));
        }
      }
    }
  }
  std::stable_sort(windows.begin(), windows.end(),
                   [](const Window& a, const Window& b) { return a.quality > b.quality; });
  return windows;
}

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

}  // namespace

std::vector<PlanarRegion> find_planar_regions(const CoarseView& view, double noise,
                                              std::size_t least_samples, std::size_t most_regions) {
  const InverseDepth inverse_depth(view, noise);
  const double tolerance = kInlier * noise;
  std::vector<std::uint8_t> taken(view.depth.size(), 0);
  std::vector<PlanarRegion> regions;
  for (const Window& window : fit_windows(view, inverse_depth, tolerance)) {
    const auto old = static_cast<std::size_t>(
        std::count_if(window.inliers.begin(), window.inliers.end(),
                      [&](std::size_t sample) { return taken[sample] != 0; }));
    if (2 * old > window.inliers.size()) continue;
    PlanarRegion region{window.m, window.inliers};
    for (int growth = 0; growth < kGrowths; ++growth) {
      region.samples = grow(view, inverse_depth, region.m, window.inliers, tolerance);
      const auto refined = fit(inverse_depth, region.samples);
      if (!refined) break;
      region.m = *refined;
    }
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

PlanarScene find_planes(const CoarseView& view, double noise) {
  // Samples of a region, at least, and regions of a scene, at most. Source: not recorded. Doubled,
  // faces that show fewer than 40 samples are not found, and matching may take twice as long.
  constexpr std::size_t kLeastSamples = 20;
  constexpr std::size_t kMostRegions = 32;
  return {view, noise, find_planar_regions(view, noise, kLeastSamples, kMostRegions)};
}

}  // namespace lockbox
