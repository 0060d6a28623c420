// SPDX-License-Identifier: BSD-3-Clause
#include "peer_report.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>

#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/statistics.hpp"
#include "peer_measures.hpp"
#include "peer_scene.hpp"

namespace lockbox::app {
namespace {

/// What is known, over all frames but the first `skipped`.
Statistics statistics_of(const PeerRun& run, const Measure& measure, std::size_t skipped = 0) {
  std::vector<double> values;
  for (std::size_t i = skipped; i < run.frames.size(); ++i) {
    const double value = measure(run.frames[i]);
    if (std::isfinite(value)) values.push_back(value);
  }
  return summarize(values);
}

/// Medians over the runs of the errors of each one.
ErrorSummary typical(const std::vector<PeerRun>& runs, const Measure& measure,
                     std::size_t skipped = 0) {
  std::vector<double> medians;
  std::vector<double> percentiles;
  std::vector<double> maxima;
  for (const PeerRun& run : runs) {
    const Statistics own = statistics_of(run, measure, skipped);
    if (own.count == 0) continue;
    medians.push_back(own.median);
    percentiles.push_back(own.percentile_95);
    maxima.push_back(own.maximum);
  }
  return {median(medians), median(percentiles), median(maxima)};
}

std::string number_or_dash(double value) {
  if (!std::isfinite(value)) return "-";
  std::ostringstream text;
  text << std::fixed << std::setprecision(value < 10.0 ? 2 : 1) << value;
  return text.str();
}

std::string text(const ErrorSummary& errors) {
  return number_or_dash(errors.median) + " / " + number_or_dash(errors.percentile_95) + " / " +
         number_or_dash(errors.maximum);
}

void print(const AccuracyRow& row) {
  std::cout << std::left << std::setw(13) << row.sequence << std::setw(13) << row.tracker;
  for (const ErrorSummary* errors :
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

/// Returns the row of all frames but the first, where the tracker begins.
TimeRow time_row(const std::string& name, const std::vector<PeerRun>& runs,
                 Elapsed PeerFrame::*part) {
  const ErrorSummary wall = typical(
      runs, [part](const PeerFrame& frame) { return (frame.*part).wall_ms; }, 1);
  const ErrorSummary cpu = typical(
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

void print_fast_row(int every, const std::vector<PeerRun>& runs,
                    const PublishedFigures& published) {
  const auto frames = frames_where(runs, [](const PeerFrame&) { return true; });
  const auto right = frames_where(runs, [](const PeerFrame& frame) { return frame.is_right(); });
  const auto tracking = frames_where(runs, is_tracking);
  const auto wrongly = frames_where(
      runs, [](const PeerFrame& frame) { return is_tracking(frame) && !frame.is_right(); });
  const ErrorSummary base = typical(runs, base_mm);
  int searches = 0;
  for (const PeerRun& run : runs) searches += run.frames.back().outcome.searches;
  std::cout << std::setw(5) << every << std::fixed << std::setprecision(1) << std::setw(8)
            << kMillimetres * runs.front().largest_step << std::setw(9)
            << kDegrees * runs.front().largest_turn << std::setw(21) << text(base) << std::setw(8)
            << frames << std::setw(8) << right << std::setw(10) << tracking << std::setw(17)
            << wrongly << std::setw(10) << searches;
  for (const FastMotionRow& row : published.fast_motion) {
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

void print_peer_accuracy(const std::vector<PeerRun>& runs, const PublishedFigures& published) {
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
    for (const AccuracyRow& row : published.accuracy) {
      if (row.sequence == sequence.name) print(row);
    }
  }
  const auto whole = frames_where(runs, [](const PeerFrame&) { return true; });
  std::cout << "frames called tracking: " << frames_where(runs, is_tracking) << " of " << whole
            << ", those of fast motion included\n";
}

void print_peer_times(const std::vector<PeerRun>& runs, const PublishedFigures& published) {
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
  for (const TimeRow& row : published.times) print(row, "moving");
}

void print_fast_motion(const std::vector<PeerRun>& runs, const PublishedFigures& published) {
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
  for (const auto& [every, own] : by_step) print_fast_row(every, own, published);
}

void print_capture(const std::vector<CaptureTrial>& trials, const PublishedFigures& published) {
  if (trials.empty()) return;
  std::cout << "\n10 steps on frame 30: trials that end near the truth (%)\n"
            << "start is off by          without search  whole tracker  M3T best  M3T fast\n";
  for (const CaptureRow& row : published.capture) {
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

}  // namespace lockbox::app
