// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/global_experiment.hpp"

#include <chrono>
#include <limits>

#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/random_frame.hpp"
#include "stoppable.hpp"

namespace lockbox {
namespace {

/// Base within 1 cm and 1 degree.
constexpr Tolerances kRight{0.01, 1.0 * kRadians};

}  // namespace

GlobalExperiment::GlobalExperiment(const ArticulatedModel& model, const PinholeCamera& camera,
                                   const SensorModel& sensor, std::uint64_t seed,
                                   const Executor& executor, const StopRequest& stop_request)
    : model_(model),
      camera_(camera),
      sensor_(sensor),
      seed_(seed),
      executor_(executor),
      options_(stoppable(stop_request)),
      registration_(model, options_.registration, executor_),
      acquisition_(model, options_, executor_, registration_, cloud_),
      comparison_(model, kRight) {
  acquisition_.prepare();
}

GlobalResult GlobalExperiment::search_scene(std::uint64_t number) {
  const RandomFrame seen =
      simulate_random_frame(model_, camera_, sensor_, seed_, number, executor_);
  const RandomScene& drawn = seen.view;
  GlobalResult result;
  result.scene = number;
  result.placement = drawn.placement;
  result.cut_off = drawn.cut_off;
  result.visible = drawn.visible;
  result.distance = drawn.truth.configuration.T_camera_base.translation().norm();
  result.determined = determines_base(seen.bound);
  const auto began = std::chrono::steady_clock::now();
  cloud_.assign(seen.frame, options_.cloud, executor_);
  const auto found = acquisition_.find(seen.frame, std::nullopt, SearchScope::anywhere);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (found) {
    compare_with_truth(*found, drawn.truth, seen.bound, result);
  } else {
    result.wrong = "nothing";
    result.translation = result.rotation = std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

void GlobalExperiment::compare_with_truth(const Answer& found, const State& truth,
                                          const Eigen::VectorXd& bound,
                                          GlobalResult& result) const {
  result.explained = found.agreement.explained;
  result.contradicted = found.agreement.contradicted;
  result.belief = found.belief;
  result.status = classify(found, options_);
  TrackingResult answer;
  answer.status = result.status;
  answer.configuration = found.configuration;
  answer.observable = known_unknowns(found, model_.tree, options_);
  const AnswerErrors errors = comparison_.compare(answer, truth, bound);
  result.rotation = errors.outcome.rotation;
  result.translation = errors.outcome.translation;
  result.within = errors.outcome.is_right();
  result.wrong = errors.wrong;
  result.right = result.wrong.empty();
}

}  // namespace lockbox
