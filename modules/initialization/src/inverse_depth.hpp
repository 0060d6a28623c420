// SPDX-License-Identifier: BSD-3-Clause
// 1/depth of a coarse view, its noise smoothed, and planes fitted to it.
//
// A plane m.p = 1 has the inverse depth 1/z = m.r along the ray r = (x/z, y/z, 1): planes are found
// by linear fits, under noise that is the same everywhere for a sensor that triangulates.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "coarse_view.hpp"

namespace lockbox {

class InverseDepth {
 public:
  /// Neighbours that continue a sample smoothly are averaged with it. noise: standard deviation of
  /// 1/depth of a sample, 1/metre. The view has to outlive this.
  InverseDepth(const CoarseView& view, double noise);

  /// 1/metre; 0 where nothing is known.
  float operator[](std::size_t sample) const { return values_[sample]; }
  std::size_t size() const { return values_.size(); }

  /// (x/z, y/z, 1)
  Eigen::Vector3f ray(std::size_t sample) const;

  /// How much 1/depth differs from that of the plane m.p = 1, 1/metre.
  float residual(const Eigen::Vector3f& m, std::size_t sample) const;

  /// Of the plane m.p = 1 through these samples by least squares; nothing if they determine none.
  std::optional<Eigen::Vector3f> fit_plane(const std::vector<std::size_t>& samples) const;

 private:
  float smoothed(int u, int v, float jump) const;

  const CoarseView& view_;
  std::vector<float> values_;
};

}  // namespace lockbox
