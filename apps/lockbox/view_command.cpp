// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <optional>
#include <tuple>
#include <utility>

#include "command_line/interruption.hpp"
#include "command_line/option_checks.hpp"
#include "command_line/output_paths.hpp"
#include "command_line/progress.hpp"
#include "commands.hpp"
#include "counted.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/visualization/live_view.hpp"
#include "model_options.hpp"
#include "plausible_states.hpp"
#include "run_viewer.hpp"
#include "source_options.hpp"

namespace lockbox::app {
namespace {

/// Shows what a device delivers, until it ends, the window is closed, or Ctrl-C.
void show_live(FrameSource& source, const ArticulatedModel& model) {
  LiveView view(model);
  const Interruption interruption;
  const Configuration unknown = unknown_configuration(model.tree);
  for (DepthFrame frame; view.is_open() && !interruption.requested() && source.next(frame);) {
    view.show(frame, unknown, frame_title(frame.index, frame.stamp, "live"));
  }
}

constexpr int kSmallest = 100;  // pixels
constexpr int kLargest = 8192;

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
    options.add_flag("--errors", choices_.errors,
                     "Begin with points coloured by their distance to the model: blue before its "
                     "surface, red behind it, grey where it is farther than 10 mm");
    options.add_option("--frame", frame_, "Begin paused at this frame, counted from 0")
        ->check(not_negative())
        ->type_name("N");
    options
        .add_option("--screenshot", screenshot_,
                    "Draw one frame into a PNG file instead of opening a window")
        ->type_name("FILE.png");
    options.add_option("--size", size_, "Of window or picture, pixels")
        ->delimiter('x')
        ->check(between(kSmallest, kLargest))
        ->type_name("WIDTHxHEIGHT")
        ->default_str("1280x800");
    options.footer(std::string(options.get_footer()) + "\n\nKeys in the window:\n" + kPlaybackHelp +
                   kSceneHelp);
  }

  ExitStatus run() override {
    const ArticulatedModel model = load();
    std::optional<RecordedFrames> frames;
    if (source_.is_given()) {
      auto source = source_.open();
      std::cerr << "source: " << source->description() << '\n';
      if (!source->frame_count()) return run_live(*source, model);
      frames.emplace(std::move(source), [this] { return source_.open(); });
    }
    RecordedRun run(model, std::move(frames), read_rows(model.tree));
    show(model, run);
    return ExitStatus::done;
  }

 private:
  ArticulatedModel load() const {
    const Activity activity("loading the model");
    return model_.load();
  }

  StatesFile read_rows(const KinematicTree& tree) const {
    if (states_.empty()) return {};
    auto file = read_states(states_, tree);
    if (file.states.empty()) throw InputError(states_, "holds no rows");
    require_plausible(states_, tree, file.states);
    return file;
  }

  ExitStatus run_live(FrameSource& source, const ArticulatedModel& model) const {
    if (!states_.empty() || !screenshot_.empty() || frame_) {
      throw InputError(source_.name(),
                       "--states, --frame and --screenshot are for recordings, not for a device");
    }
    show_live(source, model);
    return ExitStatus::done;
  }

  void show(const ArticulatedModel& model, RecordedRun& run) const {
    const std::size_t first = frame_.value_or(0);
    if (!run.at(first)) {
      throw InputError("--frame " + std::to_string(first),
                       "the run has only " + counted(run.size(), "frame"));
    }
    const bool plays = !frame_ || !screenshot_.empty();
    WindowOptions window;
    std::tie(window.width, window.height) = size_;
    RunViewer viewer(model, run, Playback(run.size(), first, plays), choices_, window);
    if (screenshot_.empty()) {
      viewer.play();
    } else {
      make_folder_of(screenshot_);
      write_png(screenshot_, viewer.picture());
    }
  }

  ModelOptions model_;
  SourceArguments source_;
  std::string states_;
  SceneChoices choices_;
  std::optional<std::size_t> frame_;
  std::string screenshot_;
  std::pair<int, int> size_ = {1280, 800};
};

}  // namespace

std::unique_ptr<Command> make_view_command() {
  return std::make_unique<ViewCommand>();
}

}  // namespace lockbox::app
