// SPDX-License-Identifier: BSD-3-Clause
// The same motion of joints and camera, faster and faster; and, after ten still frames, single
// random steps of the base or of a hinge.

#include <optional>

#include "command_line/option_checks.hpp"
#include "command_line/progress.hpp"
#include "command_line/shipped_files.hpp"
#include "experiments/experiments.hpp"
#include "speed_runs.hpp"

namespace lockbox::app {
namespace {

class Speed : public Experiment {
 public:
  void add_options(CLI::App& options) override {
    options.add_option("--frames", frames_, "Of the slowest run")->check(between(2, 100000));
    options.add_option("--fastest", fastest_, "Factor of the fastest run")->check(positive());
    options.add_option("--runs", runs_, "Steps of each of two kinds, of the base and of a hinge")
        ->check(not_negative());
  }

 private:
  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    ExperimentSettings silent = settings;
    silent.quiet = true;
    const Scene room = read_scene(find_scene("room"));
    const auto simulate_states = [&](const std::vector<State>& truth) {
      return simulate(model, truth, room, silent);
    };
    Progress progress("speed " + model.tree.name, std::nullopt, settings.quiet, "runs");
    std::size_t done = 0;
    std::vector<SpeedRun> runs;
    for (int factor = 1; factor <= fastest_; factor *= 2) {
      runs.push_back(
          follow_motion(model, factor,
                        simulate_states(faster_motion(model, usual_view(model), factor, frames_))));
      progress.update(++done);
    }
    std::vector<StepRun> steps;
    for (const StepKind kind : {StepKind::base, StepKind::hinge}) {
      for (int number = 0; number < runs_; ++number) {
        const auto truth = stepped_states(model, usual_view(model), kind, settings.seed, number);
        if (truth.empty()) continue;
        steps.push_back(follow_step(model, kind, number, simulate_states(truth)));
        progress.update(++done, steps.back().is_in_time() ? "in time" : "late");
      }
    }
    progress.finish();
    print_speed(runs, steps);
    const auto stem = settings.output / ("speed_" + model.tree.name);
    write_table(stem.string() + ".csv", speed_rows(runs));
    write_table(stem.string() + "_steps.csv", step_rows(steps));
    draw(stem, speed_figure(model.tree.name, runs, steps));
    return true;
  }

  int frames_ = 300;
  int fastest_ = 32;
  int runs_ = 20;
};

}  // namespace

std::unique_ptr<Experiment> make_speed_experiment() {
  return std::make_unique<Speed>();
}

}  // namespace lockbox::app
