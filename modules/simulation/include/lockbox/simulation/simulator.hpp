// SPDX-License-Identifier: BSD-3-Clause
// Depth frames of a model in a scene, as a sensor would deliver them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/model/states_file.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/simulation/deviation.hpp"
#include "lockbox/simulation/placed_scene.hpp"
#include "lockbox/simulation/sensor_simulator.hpp"

namespace lockbox {

namespace simulation {
class DeviatingView;
}

/// Frames depend on the state, their index and the seed alone. The tree must outlive the simulator.
class Simulator {
 public:
  /// camera: the calibration that comes with the frames; how the camera itself and its depth differ
  /// from it is the deviation.
  Simulator(const KinematicTree& tree, const PinholeCamera& camera, PlacedScene scene,
            const SensorModel& sensor, std::uint64_t seed, const Executor& executor,
            const SensorDeviation& deviation = {});
  ~Simulator();
  Simulator(Simulator&&) noexcept;

  /// Makes the frame with that index of a run. Throws InputError if the state is not known
  /// completely.
  void simulate(const State& state, std::uint64_t index, DepthFrame& frame);

  /// Returns what the last frame was made from: sampled as SensorSimulator::sample_camera says, ids
  /// the numbers of bodies, kBackgroundId and kOccluderId.
  const RenderedDepth& clean() const { return clean_; }
  /// Returns the camera that clean() was rendered with.
  const PinholeCamera& sample_camera() const { return sensor_.sample_camera(); }

  /// Returns the base pose of the last frame as the calibration shows it: the rigid pose that fits
  /// the measured surface of the model best, were there no noise. The true one without a deviation.
  Eigen::Isometry3d apparent_base() const;

 private:
  const KinematicTree& tree_;
  PlacedScene scene_;
  SensorSimulator sensor_;
  DepthRenderer renderer_;
  std::vector<Eigen::Isometry3d> T_camera_body_;
  std::vector<RenderItem> items_;
  RenderedDepth clean_;
  std::unique_ptr<simulation::DeviatingView> view_;  ///< none: the camera is as calibrated
  RenderedDepth scene_depth_;                        ///< what view_ takes
};

}  // namespace lockbox
