// SPDX-License-Identifier: BSD-3-Clause
// What the camera measured where the visible surface of the model is now.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lockbox/kernels/reprojection.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/registration/visible_surface.hpp"

namespace lockbox {

/// A visible surface whose bodies have moved since it was drawn, row by row of its view.
class ReprojectedView {
 public:
  /// All of these must outlive the object. scratch: kept by the caller, so that nothing is
  /// allocated anew.
  struct Scratch {
    std::vector<kernels::RigidMotion> motion;  ///< by body
    std::vector<std::vector<float>> expected;  ///< by worker
    std::vector<std::vector<float>> measured;
    std::vector<std::vector<std::int32_t>> pixel;
    std::vector<std::vector<std::uint32_t>> columns;
  };
  ReprojectedView(const VisibleSurface& surface, const BodyPoses& T_camera_body,
                  const TiledCloud& cloud, const Executor& executor, Scratch& scratch);

  /// Row v, in the memory of the worker that calls.
  kernels::Reprojected row(int v) const;

  /// The columns of row v behind which something was measured, by more than zone standard
  /// deviations, and those of which single precision cannot tell where they belong.
  std::span<const std::uint32_t> seen_through(int v, const SensorNoise& noise, double zone) const;

 private:
  const VisibleSurface& surface_;
  Scratch& scratch_;
  kernels::Intrinsics drawn_;
  kernels::MeasuredDepth measured_;
};

}  // namespace lockbox
