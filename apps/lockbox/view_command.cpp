// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <optional>
#include <tuple>
#include <utility>

#include "alternatives_file.hpp"
#include "command_line/interruption.hpp"
#include "command_line/option_checks.hpp"
#include "command_line/output_paths.hpp"
#include "command_line/progress.hpp"
#include "commands.hpp"
#include "counted.hpp"
#include "covariance_file.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/visualization/live_view.hpp"
#include "model_options.hpp"
#include "plausible_states.hpp"
#include "run_viewer.hpp"
#include "snapshots.hpp"
#include "source_options.hpp"
#include "video_file.hpp"

namespace lockbox::app {
namespace {

/// Shows what a device delivers, until it ends, the window is closed, or Ctrl-C.
void show_live(FrameSource& source, const std::string& name, const ArticulatedModel& model) {
  LiveView view(model, name);
  const Interruption interruption;
  const Configuration unknown = unknown_configuration(model.tree);
  std::optional<double> start;  // cameras count from another time each
  for (DepthFrame frame; view.is_open() && !interruption.requested() && source.next(frame);) {
    if (!start) start = frame.stamp;
    view.show(frame, unknown, frame_title(frame.index, frame.stamp - *start, "live"));
  }
}

constexpr int kSmallest = 100;  // pixels
constexpr int kLargest = 8192;
constexpr double kSmallestScale = 0.5;
constexpr double kLargestScale = 8.0;

class ViewCommand : public Command {
 public:
  void add_options(CLI::App& options) override {
    model_.add_to(options);
    source_.add_optional_to(options);
    options
        .add_option("--states", states_,
                    "States file of the run: its rows are shown with the frames of the same time, "
                    "or by themselves; a single row holds for all frames")
        ->type_name("FILE");
    options
        .add_option("--color", coloring_,
                    "What colours say: errors (distance of points to the model), bodies (the one "
                    "that is nearest to each point), terms (which one of the registration points "
                    "enter), uncertainty (of where the model's surface is), plain")
        ->check(one_of(coloring_names()))
        ->type_name("NAME");
    options
        .add_option("--beside", beside_,
                    "States file of another run, shown on the right with the same frames")
        ->type_name("FILE");
    options.add_option("--frame", frame_, "Begin paused at this frame, counted from 0")
        ->check(not_negative())
        ->type_name("N");
    add_picture_options(options);
    options.footer(std::string(options.get_footer()) + "\n\nKeys in the window:\n" + kPlaybackHelp +
                   scene_help());
  }

  ExitStatus run() override {
    require_free_output();
    choices_.coloring = coloring_named(coloring_);
    choices_.beside = !beside_.empty();
    const ArticulatedModel model = load();
    std::optional<RecordedFrames> frames;
    if (source_.is_given()) {
      auto source = source_.open();
      std::cerr << "source: " << source->description() << '\n';
      if (!source->frame_count()) return run_live(*source, model);
      frames.emplace(std::move(source), [this] { return source_.open(); });
    }
    RecordedRun run(model, std::move(frames), read_rows(states_, model.tree),
                    covariances_beside(states_, model.tree),
                    read_alternatives_beside(states_, model.tree));
    show(model, run);
    return ExitStatus::done;
  }

 private:
  ArticulatedModel load() const {
    const Activity activity("loading the model");
    return model_.load();
  }

  static StatesFile read_rows(const std::string& name, const KinematicTree& tree) {
    if (name.empty()) return {};
    auto file = read_states(name, tree);
    if (file.states.empty()) throw InputError(name, "holds no rows");
    require_plausible(name, tree, file.states);
    return file;
  }

  /// Returns the covariances of the same run.
  static std::vector<Eigen::MatrixXd> covariances_beside(const std::string& states,
                                                         const KinematicTree& tree) {
    if (states.empty()) return {};
    const auto file = std::filesystem::path(states).replace_filename("covariance.csv");
    return read_covariances(file, tree.unknowns());
  }

  ExitStatus run_live(FrameSource& source, const ArticulatedModel& model) const {
    if (!states_.empty() || !beside_.empty() || frame_ || !shows_window()) {
      throw InputError(source_.name(),
                       "--states, --beside, --frame, --screenshot, --pictures and --video are for "
                       "recordings, not for a device");
    }
    show_live(source, source_.name(), model);
    return ExitStatus::done;
  }

  void show(const ArticulatedModel& model, RecordedRun& run) const {
    const std::size_t first = frame_.value_or(0);
    if (!run.at(first)) {
      throw InputError("--frame " + std::to_string(first),
                       "the run has only " + counted(run.size(), "frame"));
    }
    const bool plays = !frame_ || !shows_window();
    WindowOptions window;
    std::tie(window.width, window.height) = size_;
    window.scale = scale_;
    window.title = window_title(model.tree.name, states_.empty() ? source_.name() : states_);
    std::optional<RunBeside> beside;
    std::optional<RecordedRun> other;
    if (!beside_.empty()) {
      other.emplace(model, std::nullopt, read_rows(beside_, model.tree),
                    covariances_beside(beside_, model.tree),
                    read_alternatives_beside(beside_, model.tree));
      beside = {&*other, beside_};
    }
    RunViewer viewer(model, run, Playback(run.size(), first, plays), choices_, window, beside);
    if (shows_window()) viewer.play();
    if (!screenshot_.empty()) {
      make_folder_of(screenshot_);
      write_png(screenshot_, viewer.picture());
    }
    if (!pictures_.empty() || !video_.empty()) draw_all(viewer, run.size() - first);
  }

  bool shows_window() const { return screenshot_.empty() && pictures_.empty() && video_.empty(); }

  /// Draws them as a series of pictures, a video, or both.
  void draw_all(RunViewer& viewer, std::size_t frames) const {
    Progress progress("view", frames, false);
    std::size_t count = 0;
    std::optional<VideoFile> video;
    viewer.draw_all([&](const RgbImage& picture, std::size_t frame, double stamp) {
      if (!pictures_.empty()) write_png(pictures_ / Snapshots::name_of(frame), picture);
      if (!video_.empty()) {
        if (!video) video.emplace(video_, picture.width, picture.height);
        video->add(picture, stamp);
      }
      progress.update(++count);
    });
    if (video) video->finish();
    progress.finish();
  }

  /// Checks the output before the user waits for anything.
  void require_free_output() const {
    if (!pictures_.empty()) {
      require_new(pictures_ / Snapshots::name_of(frame_.value_or(0)), overwrite_);
      make_folder(pictures_);
    }
    if (!video_.empty()) {
      require_new(video_, overwrite_);
      make_folder_of(video_);
    }
  }

  void add_picture_options(CLI::App& options) {
    options
        .add_option("--screenshot", screenshot_,
                    "Draw one frame into a PNG file instead of opening a window")
        ->type_name("FILE.png");
    options
        .add_option("--pictures", pictures_,
                    "Draw all frames, from --frame on, into PNG files in a folder instead")
        ->check(folder_name())
        ->type_name("DIR");
    options
        .add_option("--video", video_,
                    "Draw all frames, from --frame on, into a video instead; needs ffmpeg")
        ->check(video_name())
        ->type_name("FILE.mp4");
    add_overwrite_option(options, overwrite_);
    options
        .add_option("--size", size_,
                    "Of window or picture, pixels; default: 1280x800, times the scale")
        ->delimiter('x')
        ->check(between(kSmallest, kLargest))
        ->type_name("WIDTHxHEIGHT")
        ->default_str("");
    options
        .add_option("--scale", scale_,
                    "Of texts and points; default: of windows what the display asks for (Xft.dpi, "
                    "else the dots per inch of its screen, over 96), of pictures 1")
        ->check(between(kSmallestScale, kLargestScale))
        ->type_name("FACTOR")
        ->default_str("");
  }

  ModelOptions model_;
  SourceArguments source_;
  std::string states_;
  std::string beside_;
  std::string coloring_ = coloring_names().front();
  SceneChoices choices_;
  std::optional<std::size_t> frame_;
  std::string screenshot_;
  std::filesystem::path pictures_;
  std::filesystem::path video_;
  bool overwrite_ = false;
  std::pair<int, int> size_ = {0, 0};
  double scale_ = 0.0;
};

}  // namespace

std::unique_ptr<Command> make_view_command() {
  return std::make_unique<ViewCommand>();
}

}  // namespace lockbox::app
