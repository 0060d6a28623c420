// SPDX-License-Identifier: BSD-3-Clause
// A sphere seen by a tile of points, for the tests of what points find in a field.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox::kernels {

/// A sphere of 60 mm, sampled coarsely everywhere and finely in some blocks.
struct SphereField {
  static constexpr float kRadius = 0.06F;
  static constexpr float kUnit = 1e-5F;

  SphereField() {
    view.coarse_voxel = 0.02F;
    view.fine_voxel = 0.005F;
    view.coarse_scale = view.fine_scale = kUnit;
    for (int axis = 0; axis < 3; ++axis) {
      view.coarse_origin[axis] = -0.2F;
      view.coarse_size[axis] = 21;
      view.fine_origin[axis] = -0.08F;
      view.blocks[axis] = 4;
    }
    append_grid(view.coarse_origin, view.coarse_voxel, 21);
    block_first.assign(64, -1);
    for (int b = 0; b < 64; ++b) {
      if (b % 5 == 4) {
        continue;  // a hole, where the coarse grid must take over
      }
      const std::array<int, 3> index{b % 4, b / 4 % 4, b / 16};
      float origin[3];
      for (int axis = 0; axis < 3; ++axis) {
        origin[axis] = view.fine_origin[axis] +
                       static_cast<float>(index[static_cast<std::size_t>(axis)] * kBlockCells) *
                           view.fine_voxel;
      }
      block_first[static_cast<std::size_t>(b)] = static_cast<std::int32_t>(samples.size());
      append_grid(origin, view.fine_voxel, kBlockSamples);
    }
    samples.push_back(0);
    view.samples = samples.data();
    view.block_first = block_first.data();
  }

  void append_grid(const float* origin, float voxel, int size) {
    for (int k = 0; k < size; ++k) {
      for (int j = 0; j < size; ++j) {
        for (int i = 0; i < size; ++i) {
          const float d = std::hypot(origin[0] + static_cast<float>(i) * voxel,
                                     origin[1] + static_cast<float>(j) * voxel,
                                     origin[2] + static_cast<float>(k) * voxel) -
                          kRadius;
          samples.push_back(static_cast<std::int16_t>(std::lround(d / kUnit)));
        }
      }
    }
  }

  FieldView view;
  std::vector<std::int16_t> samples;
  std::vector<std::int32_t> block_first;
};

/// A sphere half a metre in front of the camera, seen by a tile of points around it.
class SeenSphere : public ::testing::Test {
 protected:
  static constexpr std::size_t kPoints = 256;

  SeenSphere() {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> around(-0.1F, 0.1F);
    for (std::size_t i = 0; i < kPoints; ++i) {
      x[i] = around(random);
      y[i] = around(random);
      z[i] = 0.5F + around(random);
    }
    x[kPoints - 1] = y[kPoints - 1] = z[kPoints - 1] = kPadding;
  }

  void look_up_all() {
    look_up(field.view, motion, noise, points(), {predicted_body.data(), predicted_depth.data()},
            kBody, kGate, hits(), planes(), has_planes);
  }
  PointSpan points() { return {x.data(), y.data(), z.data(), kPoints}; }
  FieldHits hits() {
    return {distance.data(),
            nearest.data(),
            {normal[0].data(), normal[1].data(), normal[2].data()},
            {position[0].data(), position[1].data(), position[2].data()},
            inverse_variance.data()};
  }

  using Array = std::array<float, kPoints>;
  static constexpr float kBody = 3.0F;
  static constexpr float kGate = 4.0F;
  Array predicted_body{};  ///< another body, unless a test says otherwise
  Array predicted_depth{};
  SphereField field;
  RigidMotion motion{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, -0.5F}};
  PointNoise noise{0.0005F, 0.002F, 0.001F, 0.0F};
  BodyPlanes planes() {
    return {plane_offset.data(),
            {plane_normal[0].data(), plane_normal[1].data(), plane_normal[2].data()}};
  }

  Array x, y, z, distance, nearest, inverse_variance, weight, plane_offset;
  bool has_planes = false;
  std::array<Array, 3> plane_normal;
  std::array<Array, 3> normal, position;
};

}  // namespace lockbox::kernels
