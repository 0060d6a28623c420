// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <iostream>

#include "command_line/interruption.hpp"
#include "command_line/option_checks.hpp"
#include "command_line/output_paths.hpp"
#include "command_line/progress.hpp"
#include "command_line/shipped_files.hpp"
#include "commands.hpp"
#include "lockbox/capture/camera_info.hpp"
#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/evaluation/possible_motion.hpp"
#include "lockbox/evaluation/run_bounds.hpp"
#include "lockbox/sensor/sensor_profile.hpp"
#include "lockbox/simulation/delivery.hpp"
#include "lockbox/simulation/deviating_model.hpp"
#include "lockbox/simulation/scene_fit.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "locked_folder.hpp"
#include "model_options.hpp"
#include "named_refusal.hpp"
#include "run_origin.hpp"
#include "simulation_record.hpp"
#include "simulation_states.hpp"
#include "visibility_report.hpp"

namespace lockbox::app {
namespace {

using FrameSink = std::function<void(const DepthFrame&)>;

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
        ->check(recording_or_folder_name())
        ->type_name("FILE.oni|DIR");
    add_overwrite_option(options, overwrite_);
    options
        .add_option("--sensor", sensor_,
                    "Profile of the sensor (YAML), or the name of a shipped one: " + sensor_names())
        ->check(suggested(shipped_sensor_names()))
        ->type_name("NAME|FILE");
    options.add_option("--seed", seed_, "Of the sensor's noise")->check(not_negative());
    options
        .add_option("--scene", scene_,
                    "Scene file, or the name of a shipped scene, which makes room for the model: "
                    "background and occluders")
        ->check(suggested(shipped_scenes()))
        ->type_name("FILE");
    options
        .add_option("--camera-info", camera_info_,
                    "ROS camera calibration (YAML) of the camera; default: 640x480, 575.8 px")
        ->type_name("FILE");
    CLI::Option* const deviation =
        options
            .add_option("--deviation", deviation_file_,
                        "YAML: how what is shown differs from the model; run.yaml, beside the "
                        "truth, tells it")
            ->type_name("FILE");
    options
        .add_option("--bounds", bounds_,
                    "Also write how well each frame determines every unknown: the Cramer-Rao bound "
                    "of its depth, for evaluate --bounds")
        ->check(table_name())
        ->excludes(deviation)
        ->type_name("FILE.csv");
    frames_option_ = options
                         .add_option("--frames", frames_,
                                     "Number of frames of an auto trajectory; of a states file, "
                                     "the first so many (all, if it is not given)")
                         ->check(positive())
                         ->check(whole_number());
    add_threads_option(options, threads_);
    options.add_flag("-q,--quiet", quiet_, "Say nothing but errors");
  }

  ExitStatus run() override {
    require_known_inputs();
    const bool is_recording = output_.extension() == ".oni";
    const auto folder = is_recording ? output_.parent_path() : output_;
    const auto truth = folder / "groundtruth.csv";
    const auto apparent = folder / "groundtruth_apparent.csv";
    const auto record = deviation_file_.empty() ? std::filesystem::path() : folder / "run.yaml";
    require_free(is_recording ? output_ : output_ / "depth.txt", {truth, record});
    const KinematicTree tree = model_.load_tree();
    const KinematicTree built = refused_in(deviation_file_, [&] {
      return deviating_model(tree, deviation_.object, deviation_.seed, Executor(threads_));
    });
    const std::vector<State> run = trajectory(tree);
    const PlacedScene scene = placed_scene(tree, run);
    std::vector<State> states;
    for (DeliveredFrame& frame : delivered_frames(run, deviation_.frames, deviation_.seed)) {
      states.push_back(std::move(frame.state));
      is_repeated_.push_back(frame.is_repeated);
    }
    Simulator simulator = refused_in(deviation_file_, [&] {
      return Simulator(built, camera(), scene, sensor_model(sensor_), seed_, Executor(threads_),
                       deviation_.sensor);
    });
    const std::vector<State> rendered = states;
    VisibilityReport visibility({built, camera(), scene, Executor(threads_)});
    {
      const Interruption interruption;  // also the truth of what was rendered is written then
      if (is_recording) {
        write_recording(simulator, visibility, states);
      } else {
        write_folder(simulator, visibility, states);
      }
      if (!quiet_) visibility.print_warnings();
      write_states(truth, tree, states);
      if (deviation_.sensor.is_any()) write_apparent_states(apparent, tree, states);
      if (!record.empty()) write_record(record);
    }
    if (!bounds_.empty()) write_run_bounds(tree, rendered, scene, states);
    if (!quiet_) std::cout << output_.string() << "\ntruth: " << truth.string() << '\n';
    return ExitStatus::done;
  }

 private:
  /// Whether what the command line names is there, before anything is said of the output.
  void require_known_inputs() {
    model_.file();
    sensor_model(sensor_);
    camera();
    if (!scene_.empty()) read_scene(find_scene(scene_));
    if (!deviation_file_.empty()) deviation_ = read_deviation(deviation_file_);
    if (trajectory_ != "auto" && !std::filesystem::exists(trajectory_)) {
      throw InputError(trajectory_, "there is no such file; give a states file, or auto");
    }
  }

  /// beside: files of fixed names; empty: none.
  void require_free(const std::filesystem::path& frames,
                    const std::vector<std::filesystem::path>& beside) const {
    for (const auto& file : beside) require_different(file, trajectory_);
    require_new(frames, overwrite_);
    require_new(bounds_, overwrite_);
    for (const auto& file : beside) {
      if (!overwrite_ && std::filesystem::exists(file)) {
        throw InputError(file.string(),
                         "belongs to another recording; give this one a folder of its own, such as "
                         "--output " +
                             own_folder().string() + " (--overwrite would replace it)");
      }
    }
  }

  /// Returns the folder of the same recording, but with nothing else beside it.
  std::filesystem::path own_folder() const {
    return output_.parent_path() / (output_.stem().string() + "_recording") / output_.filename();
  }

  void write_record(const std::filesystem::path& file) const {
    write_simulation_record(file, run_origin(), model_.file(),
                            {{"trajectory", trajectory_},
                             {"sensor", sensor_},
                             {"seed", std::to_string(seed_)},
                             {"scene", scene_},
                             {"camera-info", camera_info_},
                             {"deviation", deviation_file_}},
                            deviation_);
  }

  /// The truth as the calibration shows it.
  void write_apparent_states(const std::filesystem::path& file, const KinematicTree& tree,
                             std::vector<State> states) const {
    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i].configuration.T_camera_base = apparent_bases_[i];
    }
    write_states(file, tree, states);
  }

  std::vector<State> trajectory(const KinematicTree& tree) const {
    if (trajectory_ == "auto") return generated_trajectory();
    return read_trajectory(trajectory_, tree, frames_option_->count() > 0 ? frames_ : kAllStates);
  }

  std::vector<State> generated_trajectory() const {
    const Activity activity("loading the model and planning its motion", quiet_);
    const ArticulatedModel model = model_.load();
    TrajectoryOptions options;
    options.frames = frames_;
    const auto start = model.parameters.initial_configuration;
    options.T_camera_base =
        start ? start->T_camera_base : facing_pose(viewing_distance(model.tree, camera()));
    return possible_motion(model, options);
  }

  PinholeCamera camera() const {
    if (camera_info_.empty()) return sensor_model(sensor_).camera;
    const CameraCalibration calibration = read_camera_info(camera_info_);
    if (calibration.has_distortion()) {
      throw InputError(camera_info_, "images are rendered without distortion; set it to zero");
    }
    return calibration.camera;
  }

  PlacedScene placed_scene(const KinematicTree& tree, const std::vector<State>& states) const {
    if (scene_.empty()) return {};
    return {fitted(read_scene(find_scene(scene_)), tree, states.front()), states};
  }

  void write_recording(Simulator& simulator, VisibilityReport& visibility,
                       std::vector<State>& states) {
    make_folder_of(output_);
    OniWriter writer(output_, camera(), frames_per_second(states));
    render(simulator, visibility, states, [&](const DepthFrame& frame) { writer.write(frame); });
    writer.finish();
    take_recorded_stamps(output_, states);
  }

  void write_folder(Simulator& simulator, VisibilityReport& visibility,
                    std::vector<State>& states) {
    const LockedFolder folder(output_);
    std::filesystem::remove(output_ / "depth.txt");  // of what is overwritten
    DepthFolderWriter writer(output_);
    render(simulator, visibility, states, [&](const DepthFrame& frame) { writer.write(frame); });
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

  /// Renders the states; after a signal only those that were rendered are left.
  void render(Simulator& simulator, VisibilityReport& visibility, std::vector<State>& states,
              const FrameSink& write) {
    Progress progress("simulate", states.size(), quiet_);
    DepthFrame frame;
    for (std::size_t i = 0; i < states.size(); ++i) {
      progress.begin("rendering");
      if (is_repeated_[i]) {
        frame.stamp = states[i].stamp;
        frame.index = i;
        apparent_bases_.push_back(apparent_bases_.back());
      } else {
        simulator.simulate(states[i], i, frame);
        apparent_bases_.push_back(simulator.apparent_base());
      }
      visibility.add(i, states[i]);
      write(frame);
      progress.update(i + 1);
      if (interruption::requested()) states.resize(i + 1);
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
  std::string deviation_file_;
  Deviation deviation_;
  std::vector<bool> is_repeated_;                  ///< by frame
  std::vector<Eigen::Isometry3d> apparent_bases_;  ///< by frame that was rendered
  std::filesystem::path bounds_;
  int frames_ = 300;
  const CLI::Option* frames_option_ = nullptr;
  int threads_ = 0;
  bool overwrite_ = false;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_simulate_command() {
  return std::make_unique<SimulateCommand>();
}

}  // namespace lockbox::app
