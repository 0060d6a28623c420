// SPDX-License-Identifier: BSD-3-Clause
// What becomes of depth when windows of two images are matched: low steps are averaged, what is
// in front grows over what is behind, and nothing is measured where only one camera looks.
#pragma once

#include <cstdint>
#include <vector>

#include "correlated_noise.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/simulation/sensor_model.hpp"
#include "projector_shadow.hpp"
#include "random.hpp"

namespace lockbox::simulation {

/// Buffers are reused. The second camera stands at x = baseline, as a projector would.
class StereoMatching {
 public:
  StereoMatching(const SensorModel& sensor, const PinholeCamera& camera, std::uint64_t seed);

  /// The depth that would be measured without noise; infinite where nothing is.
  const RenderedDepth& match(const RenderedDepth& clean, std::uint64_t frame,
                             const NormalTable& normal, const Executor& executor);

 private:
  struct Offset {
    int du;
    int dv;
    float distance;  ///< pixels
  };

  void fatten_row(int v, const std::vector<float>& reach);
  void average_row(int v, const std::vector<float>& holes);
  float disparity_at(const std::vector<float>& disparity, int u, int v) const;
  std::size_t index(int u, int v) const;

  int width_;
  int height_;
  PinholeCamera camera_;
  double baseline_;
  float unit_disparity_depth_;  ///< where the disparity is one pixel, metres
  int window_radius_;
  float least_reach_;  ///< of what is in front, pixels
  float most_reach_;
  float hole_threshold_;         ///< of the holes' noise: below is a hole
  std::vector<Offset> offsets_;  ///< within most_reach_, the nearest first
  CorrelatedNoise reach_noise_;
  CorrelatedNoise hole_noise_;
  ProjectorShadow shadow_;
  std::vector<float> disparity_;  ///< true, 0 at infinity
  std::vector<float> fattened_;   ///< 0 where nothing is measured
  RenderedDepth matched_;
};

}  // namespace lockbox::simulation
