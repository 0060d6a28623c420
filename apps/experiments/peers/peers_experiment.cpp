// SPDX-License-Identifier: BSD-3-Clause
// The scene on which the best living tracker on the CPU, M3T, was measured: accuracy, time, fast
// motion and capture range.
#include <algorithm>
#include <optional>

#include "command_line/option_checks.hpp"
#include "command_line/progress.hpp"
#include "command_line/shipped_files.hpp"
#include "experiments/experiments.hpp"
#include "lockbox/core/error.hpp"
#include "peer_figure.hpp"
#include "peer_report.hpp"
#include "peer_scene.hpp"
#include "published_figures.hpp"

namespace lockbox::app {
namespace {

std::vector<std::string> sequence_names() {
  std::vector<std::string> names;
  for (const PeerSequence& sequence : peer_sequences()) names.push_back(sequence.name);
  return names;
}

class Peers : public Experiment {
 public:
  void add_options(CLI::App& options) override {
    options.add_option("--sequence", sequences_, "Those to run (repeatable)")
        ->check(one_of(sequence_names()));
    options.add_option("--seeds", seeds_, "Of noise, from --seed on: runs of each sequence")
        ->check(between(1, 1000));
    options.add_option("--frames", frames_, "Of each sequence: the first so many")
        ->check(between(2, kPeerFrames));
    options.add_option("--trials", trials_, "Wrong starts of each kind on frame 30")
        ->check(not_negative());
    options.add_option("--fast-points", fast_points_, "Point budget of the fast setting")
        ->check(positive());
  }

 private:
  std::vector<std::string> default_models() const override { return {"board_door_block"}; }

  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    if (settings.sensor != ExperimentSettings{}.sensor) {
      throw InputError("--sensor", "has no meaning here: each sequence has its own");
    }
    const PublishedFigures published = read_published_figures(shipped_file("peers/m3t.yaml"));
    const auto runs = all_runs(model, settings);
    const auto trials = all_trials(model, settings);
    print_peer_accuracy(runs, published);
    print_peer_times(runs, published);
    print_fast_motion(runs, published);
    print_capture(trials, published);
    const auto stem = settings.output / ("peers_" + model.tree.name);
    write_table(stem.string() + ".csv", peer_frame_rows(runs));
    write_table(stem.string() + "_capture.csv", capture_rows(trials));
    draw(stem, peer_figure(model.tree.name, runs, published));
    return true;
  }

  std::vector<PeerRun> all_runs(const ArticulatedModel& model,
                                const ExperimentSettings& settings) const {
    const auto seeds = static_cast<std::size_t>(seeds_);
    Progress progress("peers " + model.tree.name, sequences_.size() * seeds, settings.quiet,
                      "runs");
    const PeerSetting fast{peer_settings().back().name, fast_points_};
    std::vector<PeerRun> runs;
    std::size_t done = 0;
    for (const PeerSequence& sequence : peer_sequences()) {
      if (std::count(sequences_.begin(), sequences_.end(), sequence.name) == 0) continue;
      const auto truth = peer_truth(model, sequence.moves, frames_);
      for (std::size_t i = 0; i < seeds; ++i) {
        const std::uint64_t seed = settings.seed + i;
        const Recording recording = simulate_peer_sequence(model, truth, sequence, seed);
        for (const PeerSetting& setting : {peer_settings().front(), fast}) {
          runs.push_back(follow_sequence(model, setting, sequence.name, 1, seed, recording));
        }
        if (sequence.name == "moving") add_fast_motion(model, recording, seed, runs);
        progress.update(++done, sequence.name);
      }
    }
    progress.finish();
    return runs;
  }

  static void add_fast_motion(const ArticulatedModel& model, const Recording& recording,
                              std::uint64_t seed, std::vector<PeerRun>& runs) {
    for (const int k : {2, 3, 6, 10}) {
      const Recording taken = every_kth(recording, k);
      if (taken.frames.size() < 2) continue;
      runs.push_back(follow_sequence(model, peer_settings().front(), "moving", k, seed, taken));
    }
  }

  /// Each on noise of its own.
  std::vector<CaptureTrial> all_trials(const ArticulatedModel& model,
                                       const ExperimentSettings& settings) const {
    std::vector<CaptureTrial> trials;
    if (trials_ == 0) return trials;
    Progress progress("wrong starts " + model.tree.name,
                      static_cast<std::size_t>(trials_) * capture_kinds().size() * 2,
                      settings.quiet, "trials");
    const State truth = peer_truth(model, false, kCaptureFrame + 1).back();
    for (int number = 0; number < trials_; ++number) {
      const Recording view =
          simulate_peer_sequence(model, {truth}, peer_sequences().front(),
                                 settings.seed + static_cast<std::uint64_t>(number));
      for (const CaptureKind& kind : capture_kinds()) {
        for (const bool searches : {false, true}) {
          trials.push_back(
              capture(model, kind, number, settings.seed, searches, truth, view.frames.front()));
          progress.update(trials.size(), trials.back().succeeds() ? "found" : "missed");
        }
      }
    }
    progress.finish();
    return trials;
  }

  std::vector<std::string> sequences_ = sequence_names();
  int seeds_ = 5;
  int frames_ = kPeerFrames;
  int trials_ = 20;
  std::size_t fast_points_ = peer_settings().back().point_budget;
};

}  // namespace

std::unique_ptr<Experiment> make_peers_experiment() {
  return std::make_unique<Peers>();
}

}  // namespace lockbox::app
