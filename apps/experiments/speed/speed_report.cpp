// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iomanip>
#include <iostream>

#include "experiments/experiment.hpp"
#include "lockbox/core/units.hpp"
#include "speed_runs.hpp"

namespace lockbox::app {
namespace {

const char* text(StepKind kind) {
  return kind == StepKind::base ? "base" : "hinge";
}

void add_rows(const Row& run, const std::vector<FrameOutcome>& frames, Table& table) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Row row = run;
    for (const Cell& cell :
         Row{i, to_string(frames[i].status), frames[i].searches, frames[i].translation,
             frames[i].rotation, frames[i].joints, frames[i].worst_joint}) {
      row.push_back(cell);
    }
    table.add(row);
  }
}

void print_runs(const std::vector<SpeedRun>& runs) {
  std::cout << "\nspeed  base (m/s)  joints (degrees/s, m/s)  right (%)  searches\n" << std::fixed;
  StatusCount statuses;
  for (const SpeedRun& run : runs) {
    const double right =
        100.0 * static_cast<double>(run.frames_right()) / static_cast<double>(run.frames.size());
    std::cout << std::setw(4) << run.factor << 'x' << std::setprecision(2) << std::setw(12)
              << run.base_speed << std::setprecision(0) << std::setw(17)
              << kDegrees * run.turning_speed << std::setprecision(2) << std::setw(8)
              << run.sliding_speed << std::setprecision(1) << std::setw(11) << right
              << std::setw(10) << run.frames.back().searches << '\n';
    statuses += count_statuses(run.frames);
  }
  print_status_count(statuses);
  const auto broken =
      std::find_if(runs.begin(), runs.end(), [](auto& run) { return !run.holds(); });
  if (broken == runs.end()) {
    std::cout << "tracking holds at all these speeds\n";
  } else {
    std::cout << "tracking breaks at " << broken->factor << "x\n";
  }
}

void print_steps(StepKind kind, const std::vector<StepRun>& steps) {
  int own = 0;
  int in_time = 0;
  int searched = 0;
  StatusCount statuses;
  for (const StepRun& step : steps) {
    if (step.kind != kind) continue;
    ++own;
    in_time += step.is_in_time() ? 1 : 0;
    searched += step.frames.back().searches > 0 ? 1 : 0;
    statuses += count_statuses(step.frames);
  }
  if (own == 0) return;
  std::cout << (kind == StepKind::base ? "step of 8 cm and 10 degrees"
                                       : "step of a hinge by 20 degrees")
            << ": at noise level within 5 frames without searching in " << in_time << " of " << own
            << " runs; searched in " << searched << '\n';
  print_status_count(statuses);
}

Panel step_panel(StepKind kind, const std::vector<StepRun>& steps) {
  const bool base = kind == StepKind::base;
  Panel panel{"frames after the step",
              base ? "translation error (mm)" : "joint error (tolerances)",
              {},
              true,
              base ? "step of 8 cm and 10 degrees" : "step of a hinge by 20 degrees"};
  for (const StepRun& step : steps) {
    if (step.kind != kind) continue;
    Curve curve{"run " + std::to_string(step.number), {}, {}};
    for (std::size_t i = 0; i < step.frames.size(); ++i) {
      curve.x.push_back(static_cast<double>(i + 1));
      curve.y.push_back(base ? 1000.0 * step.frames[i].translation : step.frames[i].joints);
    }
    panel.curves.push_back(curve);
  }
  return panel;
}

}  // namespace

Table speed_rows(const std::vector<SpeedRun>& runs) {
  Table table({"factor", "base_speed", "turning_speed", "sliding_speed", "frame", "status",
               "searches", "translation", "rotation", "joint_error", "worst_joint"});
  for (const SpeedRun& run : runs) {
    add_rows({run.factor, run.base_speed, run.turning_speed, run.sliding_speed}, run.frames, table);
  }
  return table;
}

Table step_rows(const std::vector<StepRun>& runs) {
  Table table({"kind", "run", "joint", "frame", "status", "searches", "translation", "rotation",
               "joint_error", "worst_joint"});
  for (const StepRun& run : runs) {
    add_rows({text(run.kind), run.number, run.joint}, run.frames, table);
  }
  return table;
}

void print_speed(const std::vector<SpeedRun>& runs, const std::vector<StepRun>& steps) {
  print_runs(runs);
  for (const StepKind kind : {StepKind::base, StepKind::hinge}) print_steps(kind, steps);
}

Figure speed_figure(const std::string& name, const std::vector<SpeedRun>& runs,
                    const std::vector<StepRun>& steps) {
  Panel motion{"share of the motion (%)", "translation error (mm)", {}, true, "faster and faster"};
  for (const SpeedRun& run : runs) {
    Curve curve{std::to_string(run.factor) + "x", {}, {}};
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      curve.x.push_back(100.0 * static_cast<double>(i) /
                        static_cast<double>(run.frames.size() - 1));
      curve.y.push_back(1000.0 * run.frames[i].translation);
    }
    motion.curves.push_back(curve);
  }
  return {name + ": errors in fast motion",
          {motion, step_panel(StepKind::base, steps), step_panel(StepKind::hinge, steps)}};
}

}  // namespace lockbox::app
