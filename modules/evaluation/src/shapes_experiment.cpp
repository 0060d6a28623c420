// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/shapes_experiment.hpp"

#include <chrono>
#include <optional>

#include "free_form_scene.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/equal_poses.hpp"
#include "lockbox/evaluation/free_form_object.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/tracking/acquisition.hpp"
#include "lockbox/verification/verifier.hpp"
#include "stoppable.hpp"

namespace lockbox {
namespace {

/// At 1 m the sensor's noise allows objects of 10 cm a degree or two; wrong answers are off by
/// tens. Doubled, an animal that looks the wrong way still is wrong.
constexpr Tolerances kRightShape{0.02, 5.0 * kRadians, 0.01, 10.0 * kRadians};

ArticulatedModel load_shape(const FreeFormObject& object, const ShapeSettings& settings) {
  std::filesystem::create_directories(settings.folder);
  LoadOptions options;
  options.cache_directory = std::filesystem::path();
  options.stop_request = settings.stop_request;
  return load_model(write_free_form(object, settings.folder), options);
}

/// The joints of all shapes are seen where their bases are.
AnswerErrors errors_of(const ArticulatedModel& model, const TrackingResult& answer, State truth) {
  Eigen::Isometry3d& pose = truth.configuration.T_camera_base;
  pose = EqualPoses(model).nearest(pose, answer.configuration.T_camera_base);
  const Eigen::VectorXd known = Eigen::VectorXd::Zero(model.tree.unknowns());
  return AnswerComparison(model, kRightShape).compare(answer, truth, known);
}

}  // namespace

ShapeResult search_shape(const ObjectBlock& block, std::uint64_t number,
                         const ShapeSettings& settings, const Executor& executor) {
  const FreeFormObject object = draw_free_form(block, number);
  const ArticulatedModel model = load_shape(object, settings);
  const evaluation::FreeFormScene drawn = evaluation::draw_free_form_scene(
      model, settings.camera, block.draws(ObjectBlock::Purpose::view, number));
  DepthFrame frame;
  Simulator(model.tree, settings.camera, PlacedScene(drawn.scene, {drawn.truth}), settings.sensor,
            settings.seed, executor)
      .simulate(drawn.truth, number, frame);
  frame.index = 0;
  ShapeResult result;
  result.kind = object.name;
  result.on_table = drawn.on_table;
  result.is_covered = drawn.is_covered;
  const TrackerOptions options = stoppable(settings.stop_request);
  TiledCloud cloud;
  ArticulatedRegistration registration(model, options.registration, executor);
  Acquisition acquisition(model, options, executor, registration, cloud);
  const auto began = std::chrono::steady_clock::now();
  cloud.assign(frame, options.cloud, executor);
  const auto found = acquisition.find(frame, std::nullopt, SearchScope::anywhere);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  Verifier verifier(model.tree);
  verifier.look_at(cloud, options.registration.noise, executor);
  result.evidence_of_truth = verifier.evidence(drawn.truth.configuration).total();
  if (!found) {
    result.errors.wrong = "nothing";
    return result;
  }
  result.belief = found->belief;
  result.evidence = verifier.evidence(found->configuration).total();
  TrackingResult answer;
  answer.status = classify(*found, options);
  answer.configuration = found->configuration;
  answer.observable = known_unknowns(*found, model.tree, options);
  result.errors = errors_of(model, answer, drawn.truth);
  return result;
}

}  // namespace lockbox
