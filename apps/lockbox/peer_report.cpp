// SPDX-License-Identifier: BSD-3-Clause
#include "peer_report.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>

#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/statistics.hpp"
#include "m3t_figures.hpp"
#include "peer_scene.hpp"

namespace lockbox::app {
namespace {

using Measure = std::function<double(const PeerFrame&)>;

double base_mm(const PeerFrame& frame) {
  return kMillimetres * frame.outcome.translation;
}

double base_degrees(const PeerFrame& frame) {
  return kDegrees * frame.outcome.rotation;
}

double door_degrees(const PeerFrame& frame) {
  return kDegrees * frame.door;
}

double slide_mm(const PeerFrame& frame) {
  return kMillimetres * frame.slide;
}

/// What is known, over all frames but the first `skipped`.
Statistics spread(const PeerRun& run, const Measure& measure, std::size_t skipped = 0) {
  std::vector<double> values;
  for (std::size_t i = skipped; i < run.frames.size(); ++i) {
    const double value = measure(run.frames[i]);
    if (std::isfinite(value)) values.push_back(value);
  }
  return summarize(values);
}

double median(const std::vector<double>& values) {
  return summarize(values).median;
}

/// Medians over the runs of what each one spreads.
ErrorSpread typical(const std::vector<PeerRun>& runs, const Measure& measure,
                    std::size_t skipped = 0) {
  std::vector<double> medians;
  std::vector<double> percentiles;
  std::vector<double> maxima;
  for (const PeerRun& run : runs) {
    const Statistics own = spread(run, measure, skipped);
    if (own.count == 0) continue;
    medians.push_back(own.median);
    percentiles.push_back(own.percentile_95);
    maxima.push_back(own.maximum);
  }
  return {median(medians), median(percentiles), median(maxima)};
}

/// Those on all frames of a sequence.
std::vector<PeerRun> selected(const std::vector<PeerRun>& runs, const std::string& tracker,
                              const std::string& sequence) {
  std::vector<PeerRun> result;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(result), [&](const PeerRun& run) {
    return run.tracker == tracker && run.sequence == sequence && run.every == 1;
  });
  return result;
}

std::string number_or_dash(double value) {
  if (!std::isfinite(value)) return "-";
  std::ostringstream text;
  text << std::fixed << std::setprecision(value < 10.0 ? 2 : 1) << value;
  return text.str();
}

std::string text(const ErrorSpread& errors) {
  return number_or_dash(errors.median) + " / " + number_or_dash(errors.percentile_95) + " / " +
         number_or_dash(errors.maximum);
}

void print(const AccuracyRow& row) {
  std::cout << std::left << std::setw(13) << row.sequence << std::setw(13) << row.tracker;
  for (const ErrorSpread* errors :
       {&row.base_mm, &row.base_degrees, &row.door_degrees, &row.slide_mm}) {
    std::cout << "  " << std::setw(20) << text(*errors);
  }
  std::cout << '\n' << std::right;
}

void print(const TimeRow& row, const std::string& sequence) {
  std::cout << std::left << std::setw(13) << sequence << std::setw(20) << row.tracker << std::right
            << std::setw(8) << number_or_dash(row.median_ms) << std::setw(10)
            << number_or_dash(row.percentile_95_ms) << std::setw(14)
            << number_or_dash(row.cpu_median_ms) << '\n';
}

/// Of all frames but the first, where the tracker begins.
TimeRow time_row(const std::string& name, const std::vector<PeerRun>& runs,
                 Elapsed PeerFrame::*part) {
  const ErrorSpread wall = typical(
      runs, [part](const PeerFrame& frame) { return (frame.*part).wall_ms; }, 1);
  const ErrorSpread cpu = typical(
      runs, [part](const PeerFrame& frame) { return (frame.*part).cpu_ms; }, 1);
  return {name, wall.median, wall.percentile_95, cpu.median};
}

std::ptrdiff_t frames_where(const std::vector<PeerRun>& runs,
                            const std::function<bool(const PeerFrame&)>& holds) {
  std::ptrdiff_t count = 0;
  for (const PeerRun& run : runs) {
    count += std::count_if(run.frames.begin(), run.frames.end(), holds);
  }
  return count;
}

bool is_tracking(const PeerFrame& frame) {
  return frame.outcome.status == TrackingStatus::tracking;
}

void print_fast_row(int every, const std::vector<PeerRun>& runs) {
  const auto frames = frames_where(runs, [](const PeerFrame&) { return true; });
  const auto right = frames_where(runs, [](const PeerFrame& frame) { return frame.is_right(); });
  const auto tracking = frames_where(runs, is_tracking);
  const auto wrongly = frames_where(
      runs, [](const PeerFrame& frame) { return is_tracking(frame) && !frame.is_right(); });
  const ErrorSpread base = typical(runs, base_mm);
  int searches = 0;
  for (const PeerRun& run : runs) searches += run.frames.back().outcome.searches;
  std::cout << std::setw(5) << every << std::fixed << std::setprecision(1) << std::setw(8)
            << kMillimetres * runs.front().largest_step << std::setw(9)
            << kDegrees * runs.front().largest_turn << std::setw(21) << text(base) << std::setw(8)
            << frames << std::setw(8) << right << std::setw(10) << tracking << std::setw(17)
            << wrongly << std::setw(10) << searches;
  for (const FastMotionRow& row : m3t_fast_motion()) {
    if (row.every == every) std::cout << "  " << row.best << " | " << row.fast;
  }
  std::cout << '\n';
}

std::string percent(const std::vector<CaptureTrial>& trials, const std::string& kind,
                    bool searches) {
  int all = 0;
  int good = 0;
  for (const CaptureTrial& trial : trials) {
    if (trial.kind != kind || trial.searches != searches) continue;
    ++all;
    good += trial.succeeds() ? 1 : 0;
  }
  return all == 0 ? "-" : std::to_string(100 * good / all);
}

/// Of each frame the median over the runs.
Curve typical_curve(const std::string& name, const std::vector<PeerRun>& runs,
                    const Measure& measure) {
  Curve curve{name, {}, {}};
  for (std::size_t i = 0; i < runs.front().frames.size(); ++i) {
    std::vector<double> values;
    for (const PeerRun& run : runs) {
      const double value = measure(run.frames[i]);
      if (std::isfinite(value)) values.push_back(value);
    }
    curve.x.push_back(static_cast<double>(i));
    curve.y.push_back(median(values));
  }
  return curve;
}

Panel error_panel(const std::string& label, const std::vector<PeerRun>& runs,
                  const Measure& measure, const ErrorSpread AccuracyRow::*published) {
  Panel panel{"frame", label, {}, true};
  double last = 0.0;
  for (const PeerSequence& sequence : peer_sequences()) {
    const auto own = selected(runs, peer_settings().front().name, sequence.name);
    if (own.empty()) continue;
    panel.curves.push_back(typical_curve(sequence.name, own, measure));
    last = panel.curves.back().x.back();
  }
  for (const AccuracyRow& row : m3t_accuracy()) {
    if (row.sequence != "static" || row.tracker != "M3T best") continue;
    const ErrorSpread& errors = row.*published;
    panel.curves.push_back(
        {"M3T best, static: median", {0.0, last}, {errors.median, errors.median}});
    panel.curves.push_back(
        {"M3T best, static: maximum", {0.0, last}, {errors.maximum, errors.maximum}});
  }
  return panel;
}

}  // namespace

Table peer_frame_rows(const std::vector<PeerRun>& runs) {
  Table table({"tracker", "sequence", "every", "seed", "frame", "status", "searches", "translation",
               "x", "y", "z", "rotation", "door", "slide", "step_ms", "step_cpu_ms", "cloud_ms",
               "cloud_cpu_ms"});
  for (const PeerRun& run : runs) {
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      const PeerFrame& frame = run.frames[i];
      table.add({run.tracker, run.sequence, run.every, run.seed,
                 i * static_cast<std::size_t>(run.every), to_string(frame.outcome.status),
                 frame.outcome.searches, frame.outcome.translation, frame.offset.x(),
                 frame.offset.y(), frame.offset.z(), frame.outcome.rotation, frame.door,
                 frame.slide, frame.step_time.wall_ms, frame.step_time.cpu_ms,
                 frame.cloud_time.wall_ms, frame.cloud_time.cpu_ms});
    }
  }
  return table;
}

Table capture_rows(const std::vector<CaptureTrial>& trials) {
  Table table({"start", "trial", "searches_allowed", "status", "searches", "success", "translation",
               "rotation", "door", "slide"});
  for (const CaptureTrial& trial : trials) {
    const FrameOutcome& outcome = trial.end.outcome;
    table.add({trial.kind, trial.number, trial.searches ? 1 : 0, to_string(outcome.status),
               outcome.searches, trial.succeeds() ? 1 : 0, outcome.translation, outcome.rotation,
               trial.end.door, trial.end.slide});
  }
  return table;
}

void print_peer_accuracy(const std::vector<PeerRun>& runs) {
  std::cout << "\nmedian / 95 % / maximum of each run, medians over the seeds\n"
            << "sequence     tracker        base (mm)             base (degrees)        "
               "door (degrees)        slide (mm)\n";
  for (const PeerSequence& sequence : peer_sequences()) {
    for (const PeerSetting& setting : peer_settings()) {
      const auto own = selected(runs, setting.name, sequence.name);
      if (own.empty()) continue;
      print({sequence.name, setting.name, typical(own, base_mm), typical(own, base_degrees),
             typical(own, door_degrees), typical(own, slide_mm)});
    }
    if (selected(runs, peer_settings().front().name, sequence.name).empty()) continue;
    for (const AccuracyRow& row : m3t_accuracy()) {
      if (row.sequence == sequence.name) print(row);
    }
  }
  const auto whole = frames_where(runs, [](const PeerFrame&) { return true; });
  std::cout << "frames called tracking: " << frames_where(runs, is_tracking) << " of " << whole
            << ", those of fast motion included\n";
}

void print_peer_times(const std::vector<PeerRun>& runs) {
  std::cout << "\none thread; CPU time of that thread beside wall time\n"
            << "sequence     what             median ms  95 % ms  median CPU ms\n";
  for (const PeerSequence& sequence : peer_sequences()) {
    for (const PeerSetting& setting : peer_settings()) {
      const auto own = selected(runs, setting.name, sequence.name);
      if (own.empty()) continue;
      print(time_row(setting.name + ": step", own, &PeerFrame::step_time), sequence.name);
      print(time_row(setting.name + ": cloud", own, &PeerFrame::cloud_time), sequence.name);
    }
  }
  for (const TimeRow& row : m3t_times()) print(row, "moving");
}

void print_fast_motion(const std::vector<PeerRun>& runs) {
  std::map<int, std::vector<PeerRun>> by_step;
  for (const PeerRun& run : runs) {
    const bool is_default = run.tracker == peer_settings().front().name;
    if (is_default && run.sequence == "moving") by_step[run.every].push_back(run);
  }
  if (by_step.empty()) return;
  std::cout
      << "\nevery k-th frame of `moving`\n"
      << "    k step mm  degrees      base error (mm)  frames   right  tracking  trusted wrongly"
         "  searches  M3T best | fast (mm)\n";
  for (const auto& [every, own] : by_step) print_fast_row(every, own);
}

void print_capture(const std::vector<CaptureTrial>& trials) {
  if (trials.empty()) return;
  std::cout << "\n10 steps on frame 30: trials that end near the truth (%)\n"
            << "start is off by          without search  whole tracker  M3T best  M3T fast\n";
  for (const CaptureRow& row : m3t_capture()) {
    std::cout << std::left << std::setw(23) << row.kind << std::right << std::setw(16)
              << percent(trials, row.kind, false) << std::setw(15)
              << percent(trials, row.kind, true) << std::setw(10) << row.best << std::setw(10)
              << row.fast << '\n';
  }
  std::cout << "fail, but are called tracking: "
            << std::count_if(
                   trials.begin(), trials.end(),
                   [](const CaptureTrial& t) { return !t.succeeds() && is_tracking(t.end); })
            << " of " << trials.size() << '\n';
}

Figure peer_figure(const std::string& name, const std::vector<PeerRun>& runs) {
  return {name + ": errors on the scene on which M3T was measured, medians over the seeds",
          {error_panel("base (mm)", runs, base_mm, &AccuracyRow::base_mm),
           error_panel("base (degrees)", runs, base_degrees, &AccuracyRow::base_degrees),
           error_panel("door (degrees)", runs, door_degrees, &AccuracyRow::door_degrees),
           error_panel("slide (mm)", runs, slide_mm, &AccuracyRow::slide_mm)}};
}

}  // namespace lockbox::app
