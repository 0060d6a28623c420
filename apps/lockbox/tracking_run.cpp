// SPDX-License-Identifier: BSD-3-Clause
#include "tracking_run.hpp"

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <utility>

#include "command_line/interruption.hpp"
#include "command_line/parameters.hpp"
#include "command_line/progress.hpp"
#include "counted.hpp"
#include "lockbox/core/error.hpp"
#include "published_output.hpp"
#include "run_outputs.hpp"
#include "search_report.hpp"
#include "sensor_report.hpp"
#include "size_report.hpp"

namespace lockbox::app {
namespace {

/// Number of frames that a run will have, if that is known.
std::optional<std::size_t> expected_frames(const FrameSource& source, const RunSettings& settings) {
  const auto available = source.frame_count();
  if (settings.max_frames == 0) return available;
  return std::min(settings.max_frames, available.value_or(settings.max_frames));
}

std::string phase_after(TrackingStatus status) {
  const bool is_known = status == TrackingStatus::tracking || status == TrackingStatus::uncertain;
  return is_known ? "following the object" : "searching for the object";
}

std::string signal_text() {
  return "signal " + interruption::signal_name();
}

/// Returns why it has ended.
std::string track_all(FrameSource& source, Tracker& tracker, const RunSettings& settings,
                      RunOutputs& outputs, PublishedOutput& published, SearchReport& report) {
  Progress progress("track", expected_frames(source, settings), settings.quiet);
  SensorReport sensor_report(tracker, settings.quiet);
  SizeReport size_report(settings.quiet);
  DepthFrame frame;
  auto status = TrackingStatus::initializing;
  std::string end = "end of the source";
  while (!interruption::requested()) {
    progress.begin("waiting for a frame");
    if (!source.next(frame)) break;
    progress.begin(phase_after(status));
    const TrackingResult& result = tracker.process(frame);
    status = result.status;
    outputs.add(frame, result, source);
    report.look_at(tracker, frame, result, outputs.totals());
    sensor_report.look_at(tracker);
    size_report.look_at(result);
    progress.update(outputs.totals().frames(), to_string(status));
    if (published.is_in_vain()) break;
    if (outputs.totals().frames() == settings.max_frames) {
      end = "frame limit reached";
      break;
    }
  }
  progress.finish();
  return interruption::requested() ? signal_text() : end;
}

/// Standard output, unless lines for other programs go there.
std::ostream& summary_stream(const RunSettings& settings) {
  const auto& targets = settings.publish;
  const bool is_taken = std::find(targets.begin(), targets.end(), "stdout") != targets.end();
  return is_taken ? std::cerr : std::cout;
}

void print_published(std::ostream& out, const std::vector<Publication>& published) {
  for (const auto& publication : published) {
    if (publication.dropped == 0) continue;
    out << publication.target << ": " << counted(publication.dropped, "line")
        << " dropped: a reader was too slow, or has stopped reading\n";
  }
}

void print_summary(std::ostream& out, const RunTotals& totals, const RunSettings& settings) {
  out << counted(totals.frames(), "frame");
  for (const auto status : {TrackingStatus::initializing, TrackingStatus::tracking,
                            TrackingStatus::uncertain, TrackingStatus::lost}) {
    if (totals.frames_with(status) > 0) {
      out << ", " << totals.frames_with(status) << ' ' << to_string(status);
    }
  }
  if (totals.frames() > 0) {
    out << std::fixed << std::setprecision(1) << "; latency " << totals.latency_percentile(0.5)
        << " ms (median), " << totals.latency_percentile(0.95) << " ms (95 %)";
  }
  out << '\n';
  SizeReport::print_summary(out, totals);
  if (totals.faults().unreadable > 0) {
    out << counted(totals.faults().unreadable, "frame") << " could not be read\n";
  }
  if (totals.faults().restamped > 0) {
    out << counted(totals.faults().restamped, "time stamp") << " advanced\n";
  }
  if (totals.faults().dropped > 0) {
    out << counted(totals.faults().dropped, "frame")
        << " dropped, having come while the one before was worked on\n";
  }
  if (totals.faults().outages > 0) {
    out << counted(totals.faults().outages, "outage") << " of the device, which came back\n";
  }
  if (!settings.output.empty()) {
    out << (totals.frames() > 0 ? "results: " : "no results; the same command begins anew in ")
        << settings.output.string() << '\n';
  }
  out.flush();  // while a closed pipe is still noted
}

ExitStatus status_of(const RunTotals& totals) {
  if (totals.frames_with(TrackingStatus::tracking) == 0) return ExitStatus::never_tracked;
  return totals.ended_lost() ? ExitStatus::lost : ExitStatus::done;
}

}  // namespace

ExitStatus track_source(FrameSource& source, Tracker& tracker, const ArticulatedModel& model,
                        RunDescription description, const RunSettings& settings,
                        Publisher& publisher) {
  const Interruption interruption;
  RunOutputs outputs(model, std::move(description), settings, publisher);
  PublishedOutput published(publisher, settings);
  SearchReport report(settings.quiet);
  std::string end;
  bool is_in_vain = false;
  try {
    end = track_all(source, tracker, settings, outputs, published, report);
    publisher.close();
    is_in_vain = published.is_in_vain();
  } catch (const Stopped&) {
    if (!interruption.requested()) throw;
    end = signal_text();
  } catch (const DeviceError& error) {
    outputs.abandon(std::string("the device failed: ") + error.what());
    throw;
  } catch (const std::exception& error) {
    outputs.abandon(std::string("error: ") + error.what());
    throw;
  }
  outputs.set_parameters(parameters_in_force(tracker.options()));
  outputs.finish(end);
  const RunTotals& totals = outputs.totals();
  if (totals.frames() == 0 && !interruption.requested()) {
    throw InputError(source.description(), "delivered no frame");
  }
  if (!settings.quiet) {
    print_published(summary_stream(settings), publisher.publications());
    print_summary(summary_stream(settings), totals, settings);
  }
  if (is_in_vain) return ExitStatus::pipe_closed;
  const ExitStatus status = status_of(totals);
  if (status == ExitStatus::never_tracked) report.print_summary(tracker, totals);
  return status;
}

}  // namespace lockbox::app
