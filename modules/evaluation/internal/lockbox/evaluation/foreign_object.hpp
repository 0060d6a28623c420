// SPDX-License-Identifier: BSD-3-Clause
// Objects that nobody tuned for, found without a guess.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/stop_request.hpp"
#include "lockbox/evaluation/answer_errors.hpp"
#include "lockbox/evaluation/drawn_view.hpp"
#include "lockbox/simulation/object_block.hpp"

namespace lockbox {

/// One frame of an object of a block.
struct ForeignFrame {
  AnswerErrors errors;
  double evidence = 0.0;           ///< for the answer, nats (docs/verification.md)
  double evidence_of_truth = 0.0;  ///< what a search could have found
  double explained = 0.0;          ///< of TrackingResult
  double belief = 0.0;             ///< likewise
  double seconds = 0.0;            ///< from depth image to answer
  /// The answer is wrong, but looks the same as the truth would without deviation; or there is no
  /// answer that is trusted, and something else looks so.
  bool looks_equal = false;

  bool is_right() const { return errors.wrong.empty(); }
  bool is_trusted() const { return errors.outcome.status == TrackingStatus::tracking; }
};

struct ForeignResult {
  std::string object;  ///< its name
  int parts = 0;       ///< that move
  DrawnView view;
  std::string sensor;
  bool determined = false;  ///< the truth's own bound: base to 5 mm and 0.5 degrees
  std::vector<ForeignFrame> frames;
};

struct ForeignSettings {
  PinholeCamera camera;
  int downscale = 1;                  ///< the camera has so many times fewer columns and rows
  double size = 1.0;                  ///< objects are so many times as large, and as far away
  std::optional<std::string> sensor;  ///< none: the one that the block draws
  bool tells_sensor = false;  ///< the tracker is told the sensor's profile; else images tell
  std::uint64_t seed = 1;     ///< of the sensor's noise and of the deviation
  bool deviates = false;      ///< by a third of every moderate deviation (deviation_presets.hpp)
  int frames = 1;             ///< of the object, which stands still
  /// Made if needed; model.urdf, truth.csv, scene.yaml and deviation.yaml are written there.
  std::filesystem::path folder;
  StopRequest stop_request = nullptr;  ///< of loading and of searches
};

/// Draws the object and its view, simulates that, and lets the tracker make of it what it can,
/// without a guess. Right is a base within 2 cm and 2 degrees of the pose that the calibration
/// shows (Simulator::apparent_base), with every joint whose bound is below 1 mm or 0.5 degrees
/// within 1 cm or 5 degrees. Throws InputError if a file cannot be written, and Stopped if it was
/// stopped.
ForeignResult track_foreign_object(DrawnKind kind, const ObjectBlock& block, std::uint64_t number,
                                   const ForeignSettings& settings, const Executor& executor);

}  // namespace lockbox
