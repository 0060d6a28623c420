// SPDX-License-Identifier: BSD-3-Clause
#include "inverse_depth.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

namespace lockbox {

InverseDepth::InverseDepth(const CoarseView& view, double noise)
    : view_(view), values_(view.depth.size(), 0.0F) {
  const auto jump = static_cast<float>(4.0 * noise);
  for (int v = 0; v < view.camera.height; ++v) {
    for (int u = 0; u < view.camera.width; ++u) {
      values_[view.index(u, v)] = smoothed(u, v, jump);
    }
  }
}

/// Means of opposite neighbours do not bend a slope.
float InverseDepth::smoothed(int u, int v, float jump) const {
  const float here = view_.depth[view_.index(u, v)];
  if (!(here > 0.0F)) return 0.0F;
  const float centre = 1.0F / here;
  float sum = centre;
  float count = 1.0F;
  constexpr std::array<std::array<int, 2>, 4> kPairs{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
  for (const auto& [du, dv] : kPairs) {
    if (!view_.contains(u + du, v + dv) || !view_.contains(u - du, v - dv)) continue;
    const float a = view_.depth[view_.index(u + du, v + dv)];
    const float b = view_.depth[view_.index(u - du, v - dv)];
    if (!(a > 0.0F && b > 0.0F)) continue;
    const float pair = 1.0F / a + 1.0F / b;
    if (std::abs(pair - 2.0F * centre) < 2.0F * jump) {
      sum += pair;
      count += 2.0F;
    }
  }
  return sum / count;
}

Eigen::Vector3f InverseDepth::ray(std::size_t sample) const {
  const auto width = static_cast<std::size_t>(view_.camera.width);
  const std::size_t u = sample % width;
  const std::size_t v = sample / width;
  return view_.camera.back_project(static_cast<double>(u), static_cast<double>(v), 1.0)
      .cast<float>();
}

float InverseDepth::residual(const Eigen::Vector3f& m, std::size_t sample) const {
  return std::abs(values_[sample] - m.dot(ray(sample)));
}

std::optional<Eigen::Vector3f> InverseDepth::fit_plane(
    const std::vector<std::size_t>& samples) const {
  if (samples.size() < 6) return std::nullopt;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const std::size_t sample : samples) {
    const Eigen::Vector3d r = ray(sample).cast<double>();
    moments += r * r.transpose();
    right += static_cast<double>(values_[sample]) * r;
  }
  const Eigen::Vector3d m = moments.ldlt().solve(right);
  if (!m.allFinite() || !(m.norm() > 1e-3)) return std::nullopt;
  return m.cast<float>();
}

}  // namespace lockbox
