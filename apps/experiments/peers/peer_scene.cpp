// SPDX-License-Identifier: BSD-3-Clause
#include "peer_scene.hpp"

#include <cmath>
#include <numbers>

#include "command_line/shipped_files.hpp"
#include "experiments/experiment.hpp"
#include "lockbox/core/units.hpp"

namespace lockbox::app {
namespace {

constexpr double kOpenDoor = 60.0 * kRadians;
constexpr double kSlide = 0.2;  // metres
constexpr double kWall = 2.2;   // metres from the camera
constexpr PinholeCamera kCamera{640, 480, 570.0, 570.0, 319.5, 239.5};

// The board swings around its first pose; it is fastest there.
constexpr double kPeriod = 30.0;         // frames
constexpr double kLargestStep = 0.0103;  // metres a frame
constexpr double kLargestTurn = 0.81 * kRadians;

Eigen::Isometry3d swung(const Eigen::Isometry3d& pose, int frame) {
  const Eigen::Vector3d direction = Eigen::Vector3d(3.0, 2.0, 1.0).normalized();
  const Eigen::Vector3d axis = Eigen::Vector3d(2.0, 3.0, 1.0).normalized();
  const double angle = 2.0 * std::numbers::pi / kPeriod;
  const double swing = std::sin(angle * frame) / std::sin(angle);
  Eigen::Isometry3d result = pose;
  result.translation() += swing * kLargestStep * direction;
  result.linear() = Eigen::AngleAxisd(swing * kLargestTurn, axis) * pose.linear();
  return result;
}

/// The wall stays where it is; the arm is that of the shipped scene, without the person.
Scene scene_of(const PeerSequence& sequence) {
  Scene scene;
  ScenePlane& wall = scene.planes.emplace_back();
  wall.point = kWall * Eigen::Vector3d::UnitZ();
  if (sequence.has_arm) {
    scene.arms = read_scene(find_scene("room_with_arm")).arms;
    for (SceneArm& arm : scene.arms) arm.torso_radius = 0.0;
  }
  return scene;
}

}  // namespace

const std::vector<PeerSequence>& peer_sequences() {
  static const std::vector<PeerSequence> sequences = {
      {"static", "white", false, false},
      {"moving", "white", true, false},
      {"occluded", "white", false, true},
      {"sl_static", "structured-light", false, false},
      {"sl_moving", "structured-light", true, false},
      {"sl_occluded", "structured-light", true, true},
  };
  return sequences;
}

std::vector<State> peer_truth(const ArticulatedModel& model, bool moves, int frames) {
  const Configuration view = usual_view(model);
  auto states = still_states(view, frames);
  for (int i = 0; i < frames; ++i) {
    Configuration& configuration = states[static_cast<std::size_t>(i)].configuration;
    const double progress = static_cast<double>(i) / (kPeerFrames - 1);
    set_joint_position(model.tree, configuration, "door", kOpenDoor * progress);
    set_joint_position(model.tree, configuration, "slide", kSlide * progress);
    if (moves) configuration.T_camera_base = swung(view.T_camera_base, i);
  }
  return states;
}

Recording simulate_peer_sequence(const ArticulatedModel& model, const std::vector<State>& truth,
                                 const PeerSequence& sequence, std::uint64_t seed) {
  return simulate_recording(model.tree, truth,
                            {scene_of(sequence), kCamera, sensor_model(sequence.sensor), seed},
                            Executor());
}

Recording every_kth(const Recording& recording, int k) {
  Recording taken;
  for (std::size_t i = 0; i < recording.frames.size(); i += static_cast<std::size_t>(k)) {
    taken.truth.push_back(recording.truth[i]);
    taken.frames.push_back(recording.frames[i]);
  }
  return taken;
}

}  // namespace lockbox::app
