// SPDX-License-Identifier: BSD-3-Clause
// From the clean depth of a scene to what a sensor delivers.
#pragma once

#include <cstdint>
#include <memory>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/simulation/sensor_model.hpp"

namespace lockbox {

/// The noise of a frame depends on the seed, the frame's number and the pixel alone: the same for
/// any number of threads and any order of the frames. Reusable buffers; not thread-safe.
class SensorSimulator {
 public:
  /// seed: decides the noise. camera: is that of the frames that measure() makes.
  SensorSimulator(const SensorModel& sensor, const PinholeCamera& camera, std::uint64_t seed,
                  const Executor& executor);
  ~SensorSimulator();
  SensorSimulator(SensorSimulator&&) noexcept;
  SensorSimulator& operator=(SensorSimulator&&) noexcept;

  /// Returns the camera that the clean depth has to be rendered with: the sensor's own, or, for a
  /// sensor with lateral jitter or mixed depths, refined(camera, 2). Under jitter a pixel then
  /// takes the depth of one of the samples around it, half a pixel apart; which one is drawn such
  /// that the offset is a rounded Gaussian with the standard deviation that the model asks for.
  /// Jitter mixes no depths: an edge moves from pixel to pixel, but no pixel floats between near
  /// and far.
  const PinholeCamera& sample_camera() const;

  /// Sets all of the frame but its stamp. clean: rendered with sample_camera().
  void measure(const RenderedDepth& clean, std::uint64_t index, DepthFrame& frame);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace lockbox
