// SPDX-License-Identifier: BSD-3-Clause
// What the benchmarks of the registration work on: a model, what a sensor measures of it, and the
// configurations that a tracker would predict for those frames.
#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"

namespace lockbox {

inline const std::string kLockboxFile = LOCKBOX_SHARE_DIRECTORY "/models/lockbox/lockbox.urdf";
inline constexpr PinholeCamera kPrimeSense{640, 480, 575.8, 575.8, 319.5, 239.5};

/// What the tracker allows itself between frames: surfaces up to 3 mm off, three iterations.
inline constexpr int kIterations = 3;
inline const AlignOptions kFromPrediction{
    .annealing_sigma = 0.003, .iterations = kIterations, .is_predicted = true};

struct View {
  Configuration truth;
  Configuration predicted;  ///< 1 mm and 0.05 degrees off, each joint by 0.5 % of its range
  TiledCloud cloud;
};

struct RegistrationScene {
  ArticulatedModel model;
  std::vector<View> views;  ///< consecutive frames
};

/// The model before a wall (0.4 m behind its base), measured by a PrimeSense of that camera.
RegistrationScene make_scene(ArticulatedModel model, const std::vector<Configuration>& truths,
                             const PinholeCamera& camera);

/// The shipped lockbox in the middle of its motion: eight frames, 30 a second, in which it fills
/// the image of 640 x 480.
const RegistrationScene& shipped_lockbox();

/// The lockbox seen by that camera instead.
RegistrationScene shipped_lockbox(const PinholeCamera& camera);

/// Options without a point budget.
RegistrationOptions all_points();

/// Times registrations of the views in turn from their predictions; counts the points in the sums.
void time_registration(benchmark::State& state, const RegistrationScene& scene, int threads,
                       const RegistrationOptions& options = all_points());

/// Benchmarks whose argument is the number of threads.
void on_one_and_two_threads(benchmark::internal::Benchmark* benchmark);

}  // namespace lockbox
