// SPDX-License-Identifier: BSD-3-Clause
#include "flat_windows.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace lockbox {
namespace {

constexpr std::array<int, 2> kSizes{8, 14};  // samples along each side
constexpr double kLeastMeasured = 0.5;       // share of a window
constexpr double kLeastInliers = 0.6;        // of what is measured
constexpr double kKept = 0.7;                // share of samples, each time outliers are trimmed
constexpr int kTrims = 3;

/// Without the samples that are farthest off the plane; those within the tolerance stay.
std::vector<std::size_t> trimmed(const InverseDepth& inverse_depth, const Eigen::Vector3f& m,
                                 const std::vector<std::size_t>& samples, double tolerance) {
  std::vector<float> residuals(samples.size());
  std::transform(samples.begin(), samples.end(), residuals.begin(),
                 [&](std::size_t sample) { return inverse_depth.residual(m, sample); });
  std::vector<float> sorted = residuals;
  const auto last =
      sorted.begin() + static_cast<std::ptrdiff_t>(kKept * static_cast<double>(sorted.size()));
  std::nth_element(sorted.begin(), last, sorted.end());
  const float limit = std::max(*last, static_cast<float>(tolerance));
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (residuals[i] <= limit) kept.push_back(samples[i]);
  }
  return kept;
}

/// The plane that most of the window's samples lie in.
std::optional<FlatWindow> fit_window(const std::vector<std::size_t>& window,
                                     const InverseDepth& inverse_depth, double tolerance) {
  std::vector<std::size_t> samples = window;
  auto m = inverse_depth.fit_plane(samples);
  for (int trim = 0; trim < kTrims && m; ++trim) {
    samples = trimmed(inverse_depth, *m, samples, tolerance);
    m = inverse_depth.fit_plane(samples);
  }
  if (!m) return std::nullopt;
  FlatWindow flat{*m, 0.0, {}};
  for (const std::size_t sample : samples) {
    const double off = static_cast<double>(inverse_depth.residual(*m, sample)) / tolerance;
    if (off < 1.0) {
      flat.samples.push_back(sample);
      flat.quality += 1.0 - off * off;
    }
  }
  const bool is_flat = static_cast<double>(flat.samples.size()) >=
                       kLeastInliers * static_cast<double>(window.size());
  return is_flat ? std::optional(std::move(flat)) : std::nullopt;
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

std::vector<std::size_t> measured(const CoarseView& view, const InverseDepth& inverse_depth,
                                  const Window& window) {
  std::vector<std::size_t> samples;
  for (int v = window.top; v < window.top + window.size; ++v) {
    for (int u = window.left; u < window.left + window.size; ++u) {
      const std::size_t sample = view.index(u, v);
      if (inverse_depth[sample] > 0.0F) samples.push_back(sample);
    }
  }
  return samples;
}

}  // namespace

std::vector<FlatWindow> find_flat_windows(const CoarseView& view, const InverseDepth& inverse_depth,
                                          double tolerance, const Executor& executor) {
  const std::vector<Window> windows = windows_of(view);
  std::vector<std::optional<FlatWindow>> fits(windows.size());
  executor.for_each(windows.size(), [&](std::size_t i) {
    const auto samples = measured(view, inverse_depth, windows[i]);
    const double cells = windows[i].size * windows[i].size;
    if (static_cast<double>(samples.size()) < kLeastMeasured * cells) return;
    fits[i] = fit_window(samples, inverse_depth, tolerance);
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
