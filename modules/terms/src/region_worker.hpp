// SPDX-License-Identifier: BSD-3-Clause
// What one thread needs to draw positions of a joint and to compare patches with them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "lockbox/terms/patch_noise.hpp"
#include "lockbox/terms/region_likelihood.hpp"

namespace lockbox {

struct RegionLikelihood::Worker {
  Worker(const SensorNoise& sensor, int patch_side)
      : noise(sensor, patch_side), renderer(PinholeCamera{}, Executor(1)) {}

  /// The bodies that are moved, or the others.
  void render(const KinematicTree& tree, const Configuration& configuration,
              const std::vector<std::uint8_t>& moved, bool of_moved, RenderedDepth& image) {
    forward_kinematics(tree, configuration, poses);
    items.clear();
    for (std::size_t b = 0; b < poses.size(); ++b) {
      if ((moved[b] != 0) == of_moved) {
        items.push_back(body_item(tree, b, poses[b]));
      }
    }
    renderer.render(items, image);
  }

  /// Samples of what moves before what rests.
  void merge_with(const RenderedDepth& rest) {
    samples.resize(rest.depth.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      samples[i] = 1.0F / std::min(rest.depth[i], moving.depth[i]);  // 1 / infinity = 0
    }
  }

  PatchNoise noise;
  DepthRenderer renderer;
  Configuration trial;
  std::vector<Eigen::Isometry3d> poses;
  std::vector<RenderItem> items;
  RenderedDepth moving;
  std::vector<float> samples;  ///< inverse depths, 1/metre; 0: nothing
  std::vector<float> column_sums;
};

}  // namespace lockbox
