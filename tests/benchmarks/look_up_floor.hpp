// SPDX-License-Identifier: BSD-3-Clause
// The least that any registration on these fields must do for a point: look it up once in the one
// field that explains it, distance and gradient, and add its row to the body's sums. No search for
// the body, no noise model, no loss, no free space, no collisions, no visibility, no covariance.
#pragma once

#include <cstddef>
#include <vector>

#include "lockbox/kernels/point_to_field.hpp"
#include "registration_scene.hpp"

namespace lockbox {

/// Points of a scene's first view that lie at a body, body by body: so many of them, evenly
/// distributed, or all if there are fewer.
class LookUpFloor {
 public:
  LookUpFloor(const RegistrationScene& scene, std::size_t points);

  std::size_t points() const { return points_; }

  /// One pass over all points; returns the sum of squared distances, so that nothing is left out.
  double pass(const Executor& executor);

 private:
  struct Chunk {
    std::size_t body;
    std::size_t first;
    std::size_t size;
  };

  const RegistrationScene& scene_;
  std::size_t points_ = 0;
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> z_;
  std::vector<kernels::RigidMotion> body_from_camera_;
  std::vector<Chunk> chunks_;
  std::vector<kernels::NormalSums> sums_;  ///< by chunk
};

}  // namespace lockbox
