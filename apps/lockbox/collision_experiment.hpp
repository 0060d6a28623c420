// SPDX-License-Identifier: BSD-3-Clause
// What the collision term does to the joints: off, in its literal form, and on eroded surfaces; on
// a model whose parts touch exactly, and on a copy whose contact faces overlap.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lockbox/evaluation/metrics.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/simulation/scene.hpp"

namespace lockbox::app {

struct CollisionExperiment {
  int frames = 120;
  std::uint64_t seed = 1;  ///< of the sensor's noise
  std::string sensor = "primesense";
  Scene scene;
  bool quiet = false;
};

/// One model tracked in one mode, against the truth.
struct CollisionRun {
  std::string model;
  CollisionMode mode;
  Evaluation evaluation;
  /// By joint: the largest error in units of the reported sigma, over frames that determine it.
  std::vector<double> largest_normalized_error;
};

/// Simulates the model with all joints moving, and tracks the same frames once in each mode.
std::vector<CollisionRun> run_collision_experiment(const ArticulatedModel& model,
                                                   const CollisionExperiment& experiment);

/// Rows `model,collision,unknown,unit,frames,rmse,median,percentile_95,maximum,normalized`.
void write_collision_runs(const std::filesystem::path& file, const KinematicTree& tree,
                          const std::vector<CollisionRun>& runs);

}  // namespace lockbox::app
