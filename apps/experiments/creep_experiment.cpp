// SPDX-License-Identifier: BSD-3-Clause
// A still scene, of a model that stands alone and of one that is packed among boxes flush with it,
// as one image again and again, and with noise anew in each: what images do not determine must not
// move, what they do comes to rest.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <string>

#include "command_line/option_checks.hpp"
#include "experiments.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/table.hpp"
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox::app {
namespace {

constexpr int kFramesToRest = 10;
constexpr double kStartOff = 0.01;               // metres, to the right and upwards
constexpr double kStartTurned = 3.0 * kRadians;  // about the camera's vertical axis
constexpr double kWallBehind = 0.8;              // metres behind the base's origin

/// A wall behind, as the camera sees the base.
Scene alone(const Configuration& view) {
  Scene scene;
  const Eigen::Vector3d behind =
      view.T_camera_base.translation() + kWallBehind * Eigen::Vector3d::UnitZ();
  scene.planes.push_back({SceneFrame::world, behind, -Eigen::Vector3d::UnitZ(), {8.0, 6.0}});
  return scene;
}

/// The box around the model, in the base's frame.
Eigen::AlignedBox3d box_around(const ArticulatedModel& model, Configuration configuration) {
  configuration.T_camera_base.setIdentity();
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(model.tree, configuration, poses);
  Eigen::AlignedBox3d around;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    if (!model.fields[b]) continue;
    for (int corner = 0; corner < 8; ++corner) {
      around.extend(poses[b] * model.fields[b]->bounds().corner(
                                   static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
    }
  }
  return around;
}

/// Boxes of the model's size on all sides that the camera does not look at.
Scene packed(const ArticulatedModel& model, const Configuration& view) {
  Scene scene = alone(view);
  const Eigen::AlignedBox3d own = box_around(model, view);
  Eigen::Index depth = 0;  // the axis that the camera looks along
  view.T_camera_base.linear().row(2).cwiseAbs().maxCoeff(&depth);
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      if (i == 0 && j == 0) continue;
      Eigen::Vector3d position = own.center();
      position[(depth + 1) % 3] += i * own.sizes()[(depth + 1) % 3];
      position[(depth + 2) % 3] += j * own.sizes()[(depth + 2) % 3];
      scene.boxes.push_back(
          {SceneFrame::base, own.sizes(), Eigen::Isometry3d(Eigen::Translation3d(position))});
    }
  }
  return scene;
}

/// How far the frames from kFramesToRest on lie from the first of them, at most.
struct Creep {
  double base = 0.0;    ///< metres
  double turn = 0.0;    ///< radians
  double joints = 0.0;  ///< metres or radians, the largest
  int tracking = 0;     ///< frames, of all
  bool knows_base = true;
  int known_joints = 0;
};

Creep creep_of(const std::vector<TrackingResult>& results) {
  Creep creep;
  const Configuration& rest = results[kFramesToRest].configuration;
  for (std::size_t i = 0; i < results.size(); ++i) {
    creep.tracking += results[i].status == TrackingStatus::tracking ? 1 : 0;
    if (i < kFramesToRest) continue;
    const Configuration& now = results[i].configuration;
    const Eigen::Isometry3d moved = rest.T_camera_base.inverse() * now.T_camera_base;
    creep.base = std::max(creep.base, moved.translation().norm());
    creep.turn = std::max(creep.turn, Eigen::AngleAxisd(moved.linear()).angle());
    if (now.q.size() > 0) {
      creep.joints = std::max(creep.joints, (now.q - rest.q).cwiseAbs().maxCoeff());
    }
  }
  const std::vector<bool>& observable = results.back().observable;
  creep.knows_base =
      std::all_of(observable.begin(), observable.begin() + kBaseUnknowns, [](bool b) { return b; });
  creep.known_joints =
      static_cast<int>(std::count(observable.begin() + kBaseUnknowns, observable.end(), true));
  return creep;
}

class CreepExperiment : public Experiment {
 public:
  void add_options(CLI::App& options) override {
    options.add_option("--frames", frames_, "How often the image is shown")
        ->check(between(kFramesToRest + 1, 100000));
  }

 private:
  std::vector<std::string> default_models() const override {
    return {"carton",           "carton_pair", "rigid_block",        "cabinet",
            "board_door_block", "lockbox",     "lockbox_overlapping"};
  }

  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    const Configuration view = usual_view(model);
    Table table({"scene", "noise", "frames", "tracking", "base_mm", "base_degrees", "joints",
                 "base_is_determined", "joints_determined", "joints_of_model"});
    for (const bool is_packed : {false, true}) {
      const Scene scene = is_packed ? packed(model, view) : alone(view);
      for (const bool is_repeated : {true, false}) {
        const int images = is_repeated ? 1 : frames_;
        const Recording recording = simulate(model, still_states(view, images), scene, settings);
        const Creep creep = creep_of(track_still(model, recording, displaced(view)));
        const std::string name = is_packed ? "packed" : "alone";
        const std::string noise = is_repeated ? "repeated" : "anew";
        table.add({name, noise, frames_, creep.tracking, 1000.0 * creep.base, kDegrees * creep.turn,
                   creep.joints, creep.knows_base ? 1 : 0, creep.known_joints,
                   model.tree.variables()});
        print(model, name + ", " + noise, creep);
      }
    }
    write_table(settings.output / ("creep_" + model.tree.name + ".csv"), table);
    return true;
  }

  /// Tracks as many frames as asked for, of one image or of one each.
  std::vector<TrackingResult> track_still(const ArticulatedModel& model, const Recording& recording,
                                          const Configuration& start) const {
    Tracker tracker(model, TrackerOptions{});
    tracker.start(start);
    std::vector<TrackingResult> results;
    for (int i = 0; i < frames_; ++i) {
      const auto image = std::min(static_cast<std::size_t>(i), recording.frames.size() - 1);
      DepthFrame frame = recording.frames[image];
      frame.stamp = i / 30.0;
      frame.index = static_cast<std::uint64_t>(i);
      results.push_back(tracker.process(frame));
    }
    return results;
  }

  static Configuration displaced(const Configuration& view) {
    Configuration start = view;
    start.T_camera_base.pretranslate(Eigen::Vector3d(kStartOff, -kStartOff, 0.0));
    start.T_camera_base.linear() =
        Eigen::AngleAxisd(kStartTurned, Eigen::Vector3d::UnitY()) * start.T_camera_base.linear();
    return start;
  }

  void print(const ArticulatedModel& model, const std::string& scene, const Creep& creep) const {
    std::cout << std::left << std::setw(22) << model.tree.name << std::setw(17) << scene
              << std::right << std::setw(4) << creep.tracking << " of " << frames_ << " tracking; "
              << std::fixed << std::setprecision(4) << 1000.0 * creep.base << " mm, "
              << kDegrees * creep.turn << " degrees, joints " << std::setprecision(6)
              << creep.joints
              << " (m, rad); determined: " << (creep.knows_base ? "base" : "not the base") << ", "
              << creep.known_joints << " of " << model.tree.variables() << " joints\n";
  }

  int frames_ = 40;
};

}  // namespace

std::unique_ptr<Experiment> make_creep_experiment() {
  return std::make_unique<CreepExperiment>();
}

}  // namespace lockbox::app
