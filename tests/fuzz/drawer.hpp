// SPDX-License-Identifier: BSD-3-Clause
// A model that is small enough to be tracked hundreds of times a second, and images of it.
#pragma once

#include <vector>

#include "fuzz_input.hpp"
#include "lockbox/core/depth_frame.hpp"
#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

/// A block with a drawer in its front, which is that of the seeds: 0.5 m before the camera.
inline const ArticulatedModel& drawer() {
  static const ArticulatedModel model = [] {
    const TemporaryFolder folder;
    LoadOptions without_cache;
    without_cache.cache_directory = std::filesystem::path();
    return load_model(folder.write("drawer.urdf",
                                   R"(<robot name="drawer">
  <link name="block"><visual><geometry><box size="0.24 0.16 0.06"/></geometry></visual></link>
  <link name="front"><visual><geometry><box size="0.08 0.06 0.04"/></geometry></visual></link>
  <joint name="pull" type="prismatic"><parent link="block"/><child link="front"/>
    <origin xyz="0.05 0.02 -0.05"/><axis xyz="0 0 -1"/>
    <limit lower="0" upper="0.06" effort="1" velocity="1"/></joint>
</robot>)"),
                      without_cache);
  }();
  return model;
}

inline Configuration drawer_start() {
  Configuration configuration = rest_configuration(drawer().tree);
  configuration.T_camera_base.translation().z() = 0.53;
  return configuration;
}

/// Frames of 32 x 24 pixels, whose depths are the bytes in their order: one at least, at most that
/// many. What is missing was not measured.
inline std::vector<DepthFrame> frames_from(const std::uint8_t* data, std::size_t size,
                                           std::size_t most) {
  constexpr std::size_t kPixels = 32 * 24;
  std::vector<DepthFrame> frames;
  std::size_t at = 0;
  do {
    DepthFrame frame;
    frame.camera = {32, 24, 32.0, 32.0, 15.5, 11.5};
    frame.index = frames.size();
    frame.stamp = static_cast<double>(frames.size()) / 30.0;
    for (std::size_t pixel = 0; pixel < kPixels; ++pixel, at += 2) {
      const bool is_given = at + 1 < size;
      frame.depth.push_back(is_given ? static_cast<std::uint16_t>(data[at] | data[at + 1] << 8U)
                                     : std::uint16_t{0});
    }
    frames.push_back(frame);
  } while (at < size && frames.size() < most);
  return frames;
}

/// Ends the process unless base and joints are where something can be.
inline void require_sound(const Configuration& configuration) {
  require(configuration.T_camera_base.matrix().allFinite(), "the base's pose is finite");
  const Eigen::Matrix3d R = configuration.T_camera_base.linear();
  require((R * R.transpose()).isIdentity(1e-6), "the base's rotation is one");
  require(configuration.q.allFinite(), "joint positions are finite");
  const VariableLimits limits = variable_limits(drawer().tree, 0);
  constexpr double kRounding = 1e-6;  // metres
  require(configuration.q[0] >= limits.lower - kRounding &&
              configuration.q[0] <= limits.upper + kRounding,
          "joint positions are within their limits");
}

}  // namespace lockbox
