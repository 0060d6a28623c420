// SPDX-License-Identifier: BSD-3-Clause
#include "absent_report.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>
#include <utility>

#include "experiments/experiment.hpp"
#include "lockbox/evaluation/absent_room.hpp"
#include "lockbox/evaluation/statistics.hpp"

namespace lockbox::app {
namespace {

/// Over the frames of a kind.
struct AbsentKindSummary {
  std::set<std::string> rooms;
  std::set<std::string> rooms_with_alarm;
  std::size_t frames = 0;
  std::size_t alarms = 0;
  std::vector<double> seconds;
};

struct AbsentSummary {
  std::map<std::string, AbsentKindSummary> kinds;
  std::vector<std::string> alarms;  ///< a line each
  std::vector<double> explained;    ///< by what was found, called tracking or not, percent
  std::vector<double> explained_by_alarms;
  std::vector<double> seconds;
};

bool is_alarm(const Table& table, const Row& row) {
  return table.word(row, "status") == to_string(TrackingStatus::tracking);
}

AbsentSummary read_summary(const std::vector<std::filesystem::path>& files) {
  AbsentSummary all;
  for (const auto& file : files) {
    const Table table = read_table(file, absent_columns());
    for (const Row& row : table.rows()) {
      AbsentKindSummary& kind = all.kinds[table.word(row, "kind")];
      kind.rooms.insert(run_of(table, row));
      ++kind.frames;
      kind.seconds.push_back(table.number(row, "seconds"));
      all.seconds.push_back(kind.seconds.back());
      const double explained = 100.0 * table.number(row, "explained");
      if (std::isfinite(explained)) all.explained.push_back(explained);
      if (!is_alarm(table, row)) continue;
      ++kind.alarms;
      kind.rooms_with_alarm.insert(run_of(table, row));
      all.explained_by_alarms.push_back(explained);
      all.alarms.push_back(table.word(row, "kind") + " " + table.word(row, "room") + ", frame " +
                           table.word(row, "frame") + ": " + table.word(row, "content"));
    }
  }
  return all;
}

void print_kind(const std::string& name, const AbsentKindSummary& kind) {
  const Statistics times = summarize(kind.seconds);
  std::cout << std::left << std::setw(14) << name << std::right << std::setw(6) << kind.rooms.size()
            << std::setw(8) << kind.frames << std::setw(8) << kind.alarms << std::setw(8)
            << kind.rooms_with_alarm.size() << std::fixed << std::setprecision(2) << std::setw(9)
            << times.median << std::setw(8) << times.percentile_95 << std::setw(9) << times.maximum
            << '\n';
}

void print_kinds(const AbsentSummary& frames, bool near_misses) {
  bool has_headline = false;
  for (const AbsentKind kind : absent_kinds()) {
    const auto summary = frames.kinds.find(to_string(kind));
    if (is_near_miss(kind) != near_misses || summary == frames.kinds.end()) continue;
    if (near_misses && !std::exchange(has_headline, true)) std::cout << "near misses:\n";
    print_kind(summary->first, summary->second);
  }
}

}  // namespace

std::vector<std::string> absent_columns() {
  return {"kind", "room", "content", "frame", "status", "explained", "contradicted", "occluded",
          "x",    "y",    "z",       "qx",    "qy",     "qz",        "qw",           "seconds"};
}

void add_absent_row(Table& table, const AbsentRun& run, std::size_t frame,
                    const TrackingResult& result) {
  const Eigen::Isometry3d& T = result.configuration.T_camera_base;
  const Eigen::Quaterniond q(T.linear());
  const double seconds = 0.001 * (result.cloud_time.wall_ms + result.step_time.wall_ms);
  table.add({run.kind, run.number, run.content, frame, to_string(result.status), result.explained,
             result.contradicted, result.occluded, T.translation().x(), T.translation().y(),
             T.translation().z(), q.x(), q.y(), q.z(), q.w(), seconds});
}

std::string run_of(const Table& table, const Row& row) {
  return AbsentRun{table.word(row, "kind"), table.word(row, "room"), {}}.text();
}

Figure report_absent(const std::string& name, const std::vector<std::filesystem::path>& files) {
  const AbsentSummary frames = read_summary(files);
  std::cout << '\n'
            << name << " is not there: alarms are frames called tracking; seconds a frame\n"
            << "content        rooms  frames  alarms      in   median    95 %  longest\n"
            << "                                       rooms\n";
  print_kinds(frames, false);
  const auto recorded = frames.kinds.find(kRecordedRoom);
  if (recorded != frames.kinds.end()) print_kind(recorded->first, recorded->second);
  print_kinds(frames, true);
  for (const std::string& alarm : frames.alarms) std::cout << "  false alarm: " << alarm << '\n';
  return {name + ": not there",
          {{"explained (%)",
            "of those found (%)",
            {cumulative_curve("found", frames.explained),
             cumulative_curve("called tracking", frames.explained_by_alarms)}},
           {"time (s)", "frames (%)", {cumulative_curve("frames done", frames.seconds)}}}};
}

}  // namespace lockbox::app
