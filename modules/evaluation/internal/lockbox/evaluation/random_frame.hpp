// SPDX-License-Identifier: BSD-3-Clause
// A random view as the sensor sees it, and how much it tells.
#pragma once

#include <Eigen/Core>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/evaluation/random_scene.hpp"
#include "lockbox/simulation/sensor_model.hpp"

namespace lockbox {

struct RandomFrame {
  RandomScene view;
  DepthFrame frame;
  Eigen::VectorXd bound;  ///< of the truth, see bound_sigma: one an unknown
};

/// That of draw_random_scene, with noise that follows from the same seed and number.
RandomFrame simulate_random_frame(const ArticulatedModel& model, const PinholeCamera& camera,
                                  const SensorModel& sensor, std::uint64_t seed,
                                  std::uint64_t number, const Executor& executor);

}  // namespace lockbox
