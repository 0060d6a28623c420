// SPDX-License-Identifier: BSD-3-Clause
// The face of an experiment, and what experiments share.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lockbox/evaluation/figure.hpp"
#include "lockbox/evaluation/recording.hpp"
#include "lockbox/evaluation/status_count.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox::app {

/// What all experiments can be told.
struct ExperimentSettings {
  std::vector<std::string> models;  ///< files or shipped names; empty: those it is about
  std::filesystem::path output;
  std::string sensor = "primesense";
  bool sensor_is_given = false;  ///< by the user, who may leave it to the experiment
  std::uint64_t seed = 1;
  bool quiet = false;
};

class Experiment {
 public:
  virtual ~Experiment() = default;

  /// Declares its own options.
  virtual void add_options(CLI::App& options) = 0;

  /// Whether each run is written as it is done, and the same command goes on from there. Else the
  /// results of a model are written when all its runs are done.
  virtual bool continues() const { return false; }

  /// Model after model. False if the user stopped it; the same command then picks it up again.
  virtual bool run(const ExperimentSettings& settings);

 protected:
  /// Shipped models that it runs where none are named.
  virtual std::vector<std::string> default_models() const { return {"lockbox"}; }

  /// Writes raw rows and figures, and prints the summary. False if the user stopped it.
  virtual bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) = 0;
};

/// The model's own initial state, or at rest 1.3 m in front of the camera.
Configuration usual_view(const ArticulatedModel& model);

/// Simulates the sensor of the settings in that scene, with progress.
Recording simulate(const ArticulatedModel& model, const std::vector<State>& truth,
                   const Scene& scene, const ExperimentSettings& settings);

/// Hands all frames to the tracker; returns what it made of each.
std::vector<TrackingResult> track(Tracker& tracker, const Recording& recording);

/// How far the status `tracking` can be trusted, in two lines.
void print_status_count(const StatusCount& frames);

/// Percent of the values that are at most so large.
Curve cumulative_curve(const std::string& name, std::vector<double> values);

/// Does a run that searches. False if a signal has stopped the search: what the run was to fill is
/// half done then.
bool is_done(const std::function<void()>& run);

/// Draws the figure, or says on standard error why there is none.
void draw(const std::filesystem::path& stem, const Figure& figure);

}  // namespace lockbox::app
