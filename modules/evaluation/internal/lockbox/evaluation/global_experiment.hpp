// SPDX-License-Identifier: BSD-3-Clause
// Finding the object in random scenes, without a guess: how often it is right, and how long it
// takes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/stop_request.hpp"
#include "lockbox/evaluation/answer_errors.hpp"
#include "lockbox/evaluation/random_scene.hpp"
#include "lockbox/simulation/sensor_model.hpp"
#include "lockbox/tracking/acquisition.hpp"

namespace lockbox {

/// One scene, searched once.
struct GlobalResult {
  std::uint64_t scene = 0;  ///< its number
  Placement placement = Placement::free;
  bool cut_off = false;
  double visible = 0.0;      ///< share of the object's view
  double distance = 0.0;     ///< of the base from the camera, metres
  bool determined = false;   ///< the truth's own bound: base to 5 mm and 0.5 degrees
  bool right = false;        ///< base and joints, see search_scene
  double translation = 0.0;  ///< error of the base, metres; NaN if nothing was found
  double rotation = 0.0;     ///< radians
  std::string wrong;         ///< "base", or the joints that are wrong
  /// What the answer is called; `initializing` if there is none.
  TrackingStatus status = TrackingStatus::initializing;
  bool within = false;     ///< FrameOutcome::is_right(): what is called tracking has to be
  double explained = 0.0;  ///< of Agreement
  double contradicted = 0.0;
  double belief = 0.0;   ///< of Answer
  double seconds = 0.0;  ///< from depth image to answer
};

/// Draws the scene, simulates it and searches it, as the tracker does with a first frame. Right is
/// a base within 1 cm and 1 degree, modulo the symmetries, with every joint whose bound is below 1
/// mm or 0.5 degrees within 1 cm or 5 degrees.
class GlobalExperiment {
 public:
  GlobalExperiment(const ArticulatedModel& model, const PinholeCamera& camera,
                   const SensorModel& sensor, std::uint64_t seed, const Executor& executor,
                   const StopRequest& stop_request = nullptr);

  /// Throws Stopped if it was stopped.
  GlobalResult search_scene(std::uint64_t number);

 private:
  void compare_with_truth(const Answer& found, const State& truth, const Eigen::VectorXd& bound,
                          GlobalResult& result) const;

  const ArticulatedModel& model_;
  PinholeCamera camera_;
  SensorModel sensor_;
  std::uint64_t seed_;
  Executor executor_;
  TrackerOptions options_;
  TiledCloud cloud_;
  ArticulatedRegistration registration_;
  Acquisition acquisition_;
  AnswerComparison comparison_;
};

/// Rows of results as CSV, a list that may be continued and concatenated. A last row that is not
/// complete is left out. Throws InputError with file and line.
std::vector<GlobalResult> read_global_results(const std::filesystem::path& file);

/// Throws InputError if the file cannot be written.
void write_global_results(const std::filesystem::path& file,
                          const std::vector<GlobalResult>& results);

}  // namespace lockbox
