// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/foreign_object.hpp"

#include <chrono>
#include <fstream>

#include "equal_views.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/evaluation/bound.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/sensor/sensor_profile.hpp"
#include "lockbox/simulation/deviating_model.hpp"
#include "lockbox/simulation/deviation_presets.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/verification/verifier.hpp"
#include "stoppable.hpp"

namespace lockbox {
namespace {

constexpr double kFramePeriod = 1.0 / 30.0;  // seconds

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw InputError(file.string(), "cannot be written");
}

std::string list(const Eigen::VectorXd& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + number_text(value);
  return text + ']';
}

/// Writes a scene of planes and boxes around the object.
std::string scene_text(const Scene& scene) {
  std::string text = "moving: camera\nplanes:\n";
  for (const ScenePlane& plane : scene.planes) {
    text += "  - {frame: base, point: " + list(plane.point) + ", normal: " + list(plane.normal) +
            ", extent: " + list(plane.extent) + "}\n";
  }
  if (!scene.boxes.empty()) text += "boxes:\n";
  for (const SceneBox& box : scene.boxes) {
    text += "  - {frame: base, size: " + list(box.size) +
            ", position: " + list(box.pose.translation()) +
            ", quaternion: " + list(Eigen::Quaterniond(box.pose.linear()).coeffs()) + "}\n";
  }
  return text;
}

ObjectDraft draw_object(DrawnKind kind, const ObjectBlock& block, std::uint64_t number) {
  switch (kind) {
    case DrawnKind::furniture:
      return draw_furniture(block, number);
    case DrawnKind::board:
      return draw_board(block, number);
    case DrawnKind::household:
      return draw_household(block, number);
  }
  return {};
}

/// Its fields are built anew: hundreds of objects that come once would fill the cache.
ArticulatedModel load_object(const ObjectDraft& draft, const std::filesystem::path& folder,
                             const StopRequest& stop_request) {
  std::filesystem::create_directories(folder);
  write_text(folder / "model.urdf", urdf_text(draft));
  LoadOptions options;
  options.cache_directory = std::filesystem::path();
  options.stop_request = stop_request;
  return load_model(folder / "model.urdf", options);
}

Eigen::VectorXd bound_of(const ArticulatedModel& model, const State& truth,
                         const PlacedScene& scene, const PinholeCamera& camera,
                         const SensorModel& sensor, const Executor& executor) {
  std::vector<RenderItem> scenery;
  scene.append_items(truth, scenery);
  DepthInformation information(model.tree, camera, sensor, executor);
  return bound_sigma(information.compute(truth.configuration, scenery));
}

TrackerOptions tracker_options(const ForeignSettings& settings, const SensorModel& sensor) {
  TrackerOptions options = stoppable(settings.stop_request);
  if (settings.tells_sensor) assume_sensor(find_sensor_profile(sensor.name), options);
  return options;
}

/// Tracks one object, and compares what comes out with the truth.
class ForeignRun {
 public:
  ForeignRun(const ArticulatedModel& model, const ForeignSettings& settings,
             const SensorModel& sensor, const DrawnView& view, const Executor& executor)
      : model_(model),
        settings_(settings),
        sensor_(sensor),
        truth_(view.truth),
        scene_(view.scene, {view.truth}),
        executor_(executor),
        bound_(bound_of(model, truth_, scene_, settings.camera, sensor, executor)),
        comparison_(model, Tolerances{}),
        verifier_(model.tree),
        tracker_(model, tracker_options(settings, sensor)) {}

  const Eigen::VectorXd& bound() const { return bound_; }

  ForeignFrame track(const DepthFrame& image, const Eigen::Isometry3d& apparent_base) {
    const auto began = std::chrono::steady_clock::now();
    const TrackingResult& answer = tracker_.process(image);
    ForeignFrame frame;
    frame.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    frame.explained = answer.explained;
    frame.belief = answer.belief;
    State apparent = truth_;
    apparent.configuration.T_camera_base = apparent_base;
    frame.errors = comparison_.compare(answer, apparent, bound_);
    verifier_.look_at(tracker_.cloud(), tracker_.options().registration.noise, executor_);
    frame.evidence_of_truth = verifier_.evidence(apparent.configuration).total();
    const bool has_answer = answer.status != TrackingStatus::initializing;
    if (has_answer) frame.evidence = verifier_.evidence(answer.configuration).total();
    if (frame.is_right()) return frame;
    EqualViews equal(model_, comparison_, settings_.camera, sensor_, scene_, truth_, bound_,
                     settings_.seed, executor_);
    frame.looks_equal = (has_answer && equal.holds(answer)) || (!frame.is_trusted() && equal.any());
    return frame;
  }

 private:
  const ArticulatedModel& model_;
  const ForeignSettings& settings_;
  SensorModel sensor_;
  State truth_;
  PlacedScene scene_;
  Executor executor_;
  Eigen::VectorXd bound_;
  AnswerComparison comparison_;
  Verifier verifier_;
  Tracker tracker_;
};

Deviation deviation_of(const ForeignSettings& settings, std::uint64_t number,
                       const KinematicTree& tree) {
  if (!settings.deviates) return {};
  constexpr std::uint64_t kPieces = 1000000;  // of a seed, each with its own deviation
  return *preset_deviation("all", Severity::moderate, settings.seed * kPieces + number, tree);
}

}  // namespace

ForeignResult track_foreign_object(DrawnKind kind, const ObjectBlock& block, std::uint64_t number,
                                   const ForeignSettings& given, const Executor& executor) {
  ForeignSettings settings = given;
  settings.camera = reduced(given.camera, given.downscale);
  const ObjectDraft draft = draw_object(kind, block, number);
  const auto load = [&](const ObjectDraft& drawn) {
    return load_object(drawn, settings.folder, settings.stop_request);
  };
  ArticulatedModel model = load(draft);
  ForeignResult result;
  result.object = model.tree.name;
  result.parts = static_cast<int>(model.tree.joints.size());
  result.view = draw_view(kind, model, settings.camera, block, number);
  if (settings.size != 1.0) {
    model = load(scaled(draft, settings.size));
    result.view = scaled(result.view, model.tree, settings.size);
  }
  result.sensor = settings.sensor.value_or(draw_sensor(block, number));
  std::vector<State> run(static_cast<std::size_t>(settings.frames), result.view.truth);
  for (std::size_t i = 0; i < run.size(); ++i) run[i].stamp = kFramePeriod * static_cast<double>(i);
  write_states(settings.folder / "truth.csv", model.tree, run);
  write_text(settings.folder / "scene.yaml", scene_text(result.view.scene));
  const Deviation deviation = deviation_of(settings, number, model.tree);
  if (settings.deviates) {
    write_text(settings.folder / "deviation.yaml", deviation_text(deviation));
  }
  const KinematicTree built =
      deviating_model(model.tree, deviation.object, deviation.seed, executor);
  const SensorModel sensor = sensor_model(result.sensor);
  Simulator simulator(built, settings.camera, PlacedScene(result.view.scene, run), sensor,
                      settings.seed, executor, deviation.sensor);
  ForeignRun tracked(model, settings, sensor, result.view, executor);
  result.determined = determines_base(tracked.bound());
  DepthFrame image;
  for (std::size_t i = 0; i < run.size(); ++i) {
    simulator.simulate(run[i], i, image);
    image.index = i;
    result.frames.push_back(tracked.track(image, simulator.apparent_base()));
  }
  return result;
}

}  // namespace lockbox
