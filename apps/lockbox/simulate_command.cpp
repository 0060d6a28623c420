// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>

#include "commands.hpp"
#include "interruption.hpp"
#include "lockbox/capture/camera_info.hpp"
#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/evaluation/run_bounds.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "model_options.hpp"
#include "option_checks.hpp"
#include "output_paths.hpp"
#include "possible_motion.hpp"
#include "primesense_camera.hpp"
#include "progress.hpp"
#include "shipped_files.hpp"

namespace lockbox::app {
namespace {

constexpr int kUsualRate = 30;  // frames a second

using FrameSink = std::function<void(const DepthFrame&)>;

void require_increasing_stamps(const std::string& file, const std::vector<State>& states) {
  if (states.empty()) throw InputError(file, "holds no states");
  for (std::size_t i = 1; i < states.size(); ++i) {
    if (states[i].stamp <= states[i - 1].stamp) {
      throw InputError(file, "timestamps must increase, that of state " + std::to_string(i + 1) +
                                 " (" + std::to_string(states[i].stamp) + ") does not");
    }
  }
}

/// The nominal rate of a recording of these states.
int frames_per_second(const std::vector<State>& states) {
  if (states.size() < 2) return kUsualRate;
  const double duration = states.back().stamp - states.front().stamp;
  const double rate = static_cast<double>(states.size() - 1) / duration;
  return static_cast<int>(std::lround(std::clamp(rate, 1.0, 120.0)));
}

/// Stamps of the frames as a player of the recording sees them.
void take_recorded_stamps(const std::filesystem::path& recording, std::vector<State>& states) {
  OniPlayer player(recording);
  DepthFrame frame;
  for (State& state : states) {
    if (!player.next(frame)) throw DeviceError(recording.string() + ": frames are missing");
    state.stamp = frame.stamp;
  }
}

class SimulateCommand : public Command {
 public:
  void add_options(CLI::App& options) override {
    model_.add_to(options);
    options
        .add_option("-t,--trajectory", trajectory_,
                    "States file to render; auto: every joint passes through its range")
        ->required()
        ->type_name("FILE|auto");
    options
        .add_option("-o,--output", output_,
                    "Recording, or folder of depth images; groundtruth.csv is written beside the "
                    "one, or into the other")
        ->required()
        ->type_name("FILE.oni|DIR");
    options.add_option("--sensor", sensor_, sensor_names())->type_name("NAME");
    options.add_option("--seed", seed_, "Of the sensor's noise")->check(not_negative());
    options
        .add_option("--scene", scene_,
                    "Scene file, or the name of a shipped scene: background and occluders")
        ->type_name("FILE");
    options
        .add_option("--camera-info", camera_info_,
                    "ROS camera calibration (YAML) of the camera; default: 640x480, 575.8 px")
        ->type_name("FILE");
    options
        .add_option("--bounds", bounds_,
                    "Also write how well each frame determines every unknown: the Cramer-Rao bound "
                    "of its depth, for evaluate --bounds")
        ->type_name("FILE.csv");
    options.add_option("--frames", frames_, "Number of frames of an auto trajectory")
        ->check(positive());
    options.add_option("--threads", threads_, "Threads; 0: all cores")->check(not_negative());
    options.add_flag("-q,--quiet", quiet_, "Say nothing but errors");
  }

  ExitStatus run() override {
    const KinematicTree tree = model_.load_tree();
    std::vector<State> states = trajectory(tree);
    const PlacedScene scene =
        scene_.empty() ? PlacedScene() : PlacedScene(read_scene(find_scene(scene_)), states);
    Simulator simulator(tree, camera(), scene, sensor_model(sensor_), seed_, Executor(threads_));

    const bool is_recording = output_.extension() == ".oni";
    const auto truth = (is_recording ? output_.parent_path() : output_) / "groundtruth.csv";
    require_different(truth, trajectory_);
    const std::vector<State> rendered = states;
    if (is_recording) {
      write_recording(simulator, states);
    } else {
      write_folder(simulator, states);
    }
    write_states(truth, tree, states);
    if (!bounds_.empty()) write_run_bounds(tree, rendered, scene, states);
    if (!quiet_) std::cout << output_.string() << "\ntruth: " << truth.string() << '\n';
    return ExitStatus::done;
  }

 private:
  std::vector<State> trajectory(const KinematicTree& tree) const {
    if (trajectory_ == "auto") return generated_trajectory();
    std::vector<State> states = read_states(trajectory_, tree).states;
    require_increasing_stamps(trajectory_, states);
    return states;
  }

  std::vector<State> generated_trajectory() const {
    const ArticulatedModel model = model_.load();
    TrajectoryOptions options;
    options.frames = frames_;
    const auto start = model.parameters.initial_configuration;
    if (start) options.T_camera_base = start->T_camera_base;
    return possible_motion(model, options);
  }

  PinholeCamera camera() const {
    if (camera_info_.empty()) return kPrimeSenseCamera;
    const CameraCalibration calibration = read_camera_info(camera_info_);
    if (calibration.has_distortion()) {
      throw InputError(camera_info_, "images are rendered without distortion; set it to zero");
    }
    return calibration.camera;
  }

  void write_recording(Simulator& simulator, std::vector<State>& states) const {
    make_folder_of(output_);
    OniWriter writer(output_, camera(), frames_per_second(states));
    render(simulator, states, [&](const DepthFrame& frame) { writer.write(frame); });
    writer.finish();
    take_recorded_stamps(output_, states);
  }

  void write_folder(Simulator& simulator, std::vector<State>& states) const {
    DepthFolderWriter writer(output_);
    render(simulator, states, [&](const DepthFrame& frame) { writer.write(frame); });
  }

  /// The scene's occluders move with the stamps that were rendered; the file carries the recorded.
  void write_run_bounds(const KinematicTree& tree, std::vector<State> rendered,
                        const PlacedScene& scene, const std::vector<State>& recorded) const {
    rendered.resize(recorded.size());
    Progress progress("bounds", rendered.size(), quiet_);
    std::vector<FrameBound> bounds = compute_run_bounds(
        tree, rendered, camera(), sensor_model(sensor_), scene, Executor(threads_),
        [&](std::size_t frames) { progress.update(frames); });
    progress.finish();
    for (std::size_t i = 0; i < bounds.size(); ++i) bounds[i].stamp = recorded[i].stamp;
    make_folder_of(bounds_);
    write_bounds(bounds_, tree, bounds);
  }

  /// Renders the states; after Ctrl-C only those that were rendered are left.
  void render(Simulator& simulator, std::vector<State>& states, const FrameSink& write) const {
    const Interruption interruption;
    Progress progress("simulate", states.size(), quiet_);
    DepthFrame frame;
    for (std::size_t i = 0; i < states.size(); ++i) {
      simulator.simulate(states[i], i, frame);
      write(frame);
      progress.update(i + 1);
      if (interruption.requested()) states.resize(i + 1);
    }
    progress.finish();
  }

  ModelOptions model_;
  std::string trajectory_;
  std::filesystem::path output_;
  std::string sensor_ = "primesense";
  std::uint64_t seed_ = 1;
  std::string scene_;
  std::string camera_info_;
  std::filesystem::path bounds_;
  int frames_ = 300;
  int threads_ = 0;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_simulate_command() {
  return std::make_unique<SimulateCommand>();
}

}  // namespace lockbox::app
