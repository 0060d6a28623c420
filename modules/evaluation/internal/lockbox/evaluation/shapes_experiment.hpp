// SPDX-License-Identifier: BSD-3-Clause
// Round and free-form objects in random scenes, found without a guess.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/core/stop_request.hpp"
#include "lockbox/evaluation/answer_errors.hpp"
#include "lockbox/simulation/object_block.hpp"
#include "lockbox/simulation/sensor_model.hpp"

namespace lockbox {

/// One object in one scene, searched once.
struct ShapeResult {
  std::string kind;
  bool on_table = false;
  bool is_covered = false;         ///< about a third of it is hidden
  AnswerErrors errors;             ///< against the nearest pose that looks the same
  double evidence = 0.0;           ///< for the answer, nats (docs/verification.md)
  double evidence_of_truth = 0.0;  ///< what a search could have found
  double belief = 0.0;             ///< of Answer
  double seconds = 0.0;            ///< from depth image to answer

  bool is_right() const { return errors.wrong.empty(); }
};

struct ShapeSettings {
  PinholeCamera camera;
  SensorModel sensor;
  std::uint64_t seed = 1;              ///< of the sensor's noise
  std::filesystem::path folder;        ///< made if needed; the object's files are written there
  StopRequest stop_request = nullptr;  ///< of loading and of the search
};

/// Draws the object and its scene, simulates it, and searches it as the tracker does with a first
/// frame; an answer is trusted if its status is `tracking`. Right is a base
/// within 2 cm and 5 degrees of a pose that looks the same, every joint within 10 degrees. Throws
/// InputError if a file cannot be written, and Stopped if it was stopped.
ShapeResult search_shape(const ObjectBlock& block, std::uint64_t number,
                         const ShapeSettings& settings, const Executor& executor);

}  // namespace lockbox
