// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <memory>

#include "command_line/interruption.hpp"
#include "command_line/nearest_name.hpp"
#include "command_line/option_checks.hpp"
#include "command_line/output_paths.hpp"
#include "command_line/parameters.hpp"
#include "command_line/progress.hpp"
#include "commands.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/model/states_file.hpp"
#include "lockbox/publishing/publish_target.hpp"
#include "lockbox/publishing/publisher.hpp"
#include "locked_folder.hpp"
#include "model_options.hpp"
#include "plausible_states.hpp"
#include "run_writer.hpp"
#include "snapshots.hpp"
#include "source_options.hpp"
#include "symmetry_note.hpp"
#include "tracking_run.hpp"

namespace lockbox::app {
namespace {

/// Seconds: as long as one waits for a first answer without wondering. Doubled, an object that is
/// hard to find is found two frames earlier, in frames that take twice as long.
constexpr double kSearchLimit = 1.5;

const std::map<std::string, CollisionMode> kCollisionModes = {{"off", CollisionMode::off},
                                                              {"literal", CollisionMode::literal},
                                                              {"eroded", CollisionMode::eroded}};

Configuration first_state(const std::string& file, const KinematicTree& tree) {
  const StatesFile states = read_states(file, tree);
  if (states.states.empty() || !states.states.front().known) {
    throw InputError(file, "the first row must hold the state to start from");
  }
  require_plausible(file, tree, {states.states.front()});
  return states.states.front().configuration;
}

/// Throws InputError with the name that was meant.
int index_of_joint(const KinematicTree& tree, const std::string& name) try {
  return joint_index(tree, name);
} catch (const InputError& error) {
  std::vector<std::string> names;
  for (const Joint& joint : tree.joints) names.push_back(joint.name);
  throw InputError("--lock-joint", error.what() + did_you_mean(name, names));
}

class TrackCommand : public Command {
 public:
  void add_options(CLI::App& options) override {
    options_ = &options;
    model_.add_to(options);
    source_.add_to(options);
    options.footer(std::string(options.get_footer()) + "\n\n" + kTrackStatusHelp);
    options
        .add_option("--initial-state", initial_state_,
                    "States file whose first row is the start; auto: found, no guess needed")
        ->type_name("FILE|auto");
    add_output_options(options);
    add_tracker_options(options);
  }

  ExitStatus run() override {
    require_known_inputs();
    require_free_output();
    Publisher publisher(publish_targets());
    if (!settings_.quiet) print_addresses(publisher);
    const ArticulatedModel model = load();
    auto source = open();
    TrackerOptions tracker_options = make_tracker_options(model.tree);
    tracker_options.background_search = source->is_realtime();
    if (is_short(*source)) tracker_options.search_limit = std::numeric_limits<double>::infinity();
    tracker_options.try_other_readings = true;
    tracker_options.try_other_units = !source->is_unit_stated();
    tracker_options.stop_request = interruption::requested;
    for (const std::string& parameter : parameters_) set_parameter(parameter, tracker_options);
    Tracker tracker(model, tracker_options);
    if (initial_state_ != "auto") tracker.start(first_state(initial_state_, model.tree));
    if (!settings_.quiet) {
      std::cerr << "source: " << source->description() << '\n';
      if (settings_.output.empty()) std::cerr << "no --output: results are not written\n";
      print_symmetries(model);
    }
    RunDescription description;
    description.origin = run_origin();
    description.model = model.file;
    description.source = source_.name();
    description.options = options_in_force(*options_);
    description.parameters = parameters_in_force(tracker.options());
    return track_source(*source, tracker, model, std::move(description), settings_, publisher);
  }

 private:
  /// Whether what the command line names is there, before anything is said of the output.
  void require_known_inputs() const {
    model_.file();
    source_.require_existing();
    if (initial_state_ != "auto" && !std::filesystem::exists(initial_state_)) {
      throw InputError(initial_state_, "there is no such file; give a states file, or auto");
    }
  }

  /// Checks the output before the user waits for anything.
  void require_free_output() const {
    if (!settings_.recording.empty()) {
      require_different(settings_.recording, source_.name());
      require_new(settings_.recording, settings_.overwrite);
      make_folder_of(settings_.recording);
    }
    if (!settings_.snapshots.empty()) {
      require_new(settings_.snapshots / Snapshots::kFirst, settings_.overwrite);
    }
    if (std::filesystem::is_directory(settings_.output)) {
      const LockedFolder folder(settings_.output);
      if (require_no_rows(settings_.output, settings_.overwrite) && !settings_.quiet) {
        std::cerr << "lockbox: " << settings_.output.string()
                  << " holds a run that ended before its first row; it is replaced\n";
      }
    }
  }

  std::vector<PublishTarget> publish_targets() const {
    std::vector<PublishTarget> targets;
    for (const auto& text : settings_.publish) targets.push_back(parse_publish_target(text));
    return targets;
  }

  static void print_addresses(const Publisher& publisher) {
    for (const auto& address : publisher.addresses())
      std::cerr << "publishing: " << address << '\n';
  }

  static void print_symmetries(const ArticulatedModel& model) {
    const EqualPoses equal(model);
    if (!equal.any()) return;
    std::cerr << "lockbox: " << symmetry_text(model.tree, equal)
              << ": these poses cannot be told apart, any of them may be found\n";
  }

  ArticulatedModel load() const {
    const Activity activity("loading the model", settings_.quiet);
    return model_.load();
  }

  std::unique_ptr<FrameSource> open() const {
    const Activity activity("opening the source", settings_.quiet);
    return source_.open();
  }

  /// Whether it ends before a search does that goes on in later frames.
  bool is_short(const FrameSource& source) const {
    constexpr std::size_t kFramesOfSearch = 9;  // its last round is in the ninth frame
    const auto frames = source.frame_count();
    const bool ends = frames && *frames < kFramesOfSearch;
    return ends || (settings_.max_frames > 0 && settings_.max_frames < kFramesOfSearch);
  }

  void add_output_options(CLI::App& options) {
    options
        .add_option("-o,--output", settings_.output, "Folder for states.csv, base.tum and run.yaml")
        ->check(folder_name())
        ->type_name("DIR");
    add_overwrite_option(options, settings_.overwrite);
    options.add_flag("--covariance", settings_.covariance, "Also write covariance.csv");
    options.add_option("--record", settings_.recording, "Also record the frames")
        ->check(recording_name())
        ->type_name("FILE.oni");
    options
        .add_option("--snapshots", settings_.snapshots,
                    "Folder for pictures of the model over the depth image")
        ->check(folder_name())
        ->type_name("DIR");
    options
        .add_option("--snapshot-interval", settings_.snapshot_interval,
                    "Frames from one picture to the next")
        ->check(positive())
        ->check(whole_number());
    options.add_flag("--view", settings_.view,
                     "Also show the newest frame and estimate in a 3D window (keys are explained "
                     "there); closing it ends the view only");
    options
        .add_option("--publish", settings_.publish,
                    "Also give each frame's state to other programs, as one line of JSON: stdout, "
                    "tcp:PORT, tcp:HOST:PORT, unix:PATH or udp:HOST:PORT (repeatable)")
        ->check(readable(parse_publish_target))
        ->check(suggested({"stdout", "tcp:", "unix:", "udp:"}))
        ->type_name("TARGET")
        ->default_str("");
    options.add_option("--max-frames", settings_.max_frames, "Stop after so many frames; 0: never")
        ->check(not_negative())
        ->check(whole_number());
    options.add_flag("-q,--quiet", settings_.quiet, "Say nothing but errors");
  }

  void add_tracker_options(CLI::App& options) {
    RegistrationOptions& registration = tracker_.registration;
    tracker_.search_limit = kSearchLimit;
    add_threads_option(options, tracker_.threads);
    options
        .add_option("--iterations", registration.max_iterations,
                    "Linearisations a frame; more follow while surfaces still move")
        ->check(positive())
        ->check(whole_number());
    options
        .add_option("--point-budget", registration.point_budget,
                    "Points used a frame, at most about, those that tell most; 0: all")
        ->check(not_negative())
        ->check(whole_number());
    options
        .add_option(
            "--search-limit", tracker_.search_limit,
            "Seconds that a search of the whole frame may take from one frame, counted as 1.5 "
            "for each of its rounds: one that needs more goes on in the next frames")
        ->check(positive())
        ->type_name("SECONDS");
    options.add_flag("--fixed-base", registration.fixed_base, "The base does not move");
    options.add_option("--lock-joint", locked_joints_, "Hold this joint (repeatable)")
        ->type_name("NAME")
        ->default_str("");
    options.add_option("--collision", collision_, "off, literal or eroded")
        ->check(one_of({"off", "literal", "eroded"}))
        ->type_name("MODE");
    add_set_option(options, parameters_);
  }

  TrackerOptions make_tracker_options(const KinematicTree& tree) const {
    TrackerOptions options = tracker_;
    if (const auto sensor = source_.sensor()) assume_sensor(*sensor, options);
    options.registration.collision = kCollisionModes.at(collision_);
    if (!locked_joints_.empty()) {
      options.registration.locked.assign(static_cast<std::size_t>(tree.variables()), false);
    }
    for (const auto& name : locked_joints_) {
      const Joint& joint = tree.joints[static_cast<std::size_t>(index_of_joint(tree, name))];
      options.registration.locked[static_cast<std::size_t>(joint.variable)] = true;
    }
    return options;
  }

  const CLI::App* options_ = nullptr;
  ModelOptions model_;
  SourceArguments source_;
  std::string initial_state_ = "auto";
  RunSettings settings_;
  TrackerOptions tracker_;
  std::string collision_ = "eroded";
  std::vector<std::string> locked_joints_;
  std::vector<std::string> parameters_;
};

}  // namespace

std::unique_ptr<Command> make_track_command() {
  return std::make_unique<TrackCommand>();
}

}  // namespace lockbox::app
