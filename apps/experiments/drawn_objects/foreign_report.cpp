// SPDX-License-Identifier: BSD-3-Clause
#include "foreign_report.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <map>
#include <utility>

#include "answer_rows.hpp"
#include "experiments/experiment.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/statistics.hpp"

namespace lockbox::app {
namespace {

/// What of the rows counts.
enum class Verdict { right, wrong, looks_equal, undetermined };

Verdict verdict(const Table& table, const Row& row) {
  if (table.number(row, "looks_equal") != 0.0) return Verdict::looks_equal;
  if (table.number(row, "determined") == 0.0) return Verdict::undetermined;
  return table.number(row, "right") != 0.0 ? Verdict::right : Verdict::wrong;
}

}  // namespace

std::vector<std::string> foreign_columns() {
  return {"piece",     "frame",       "kind",        "parts",      "open",
          "placement", "view",        "sensor",      "determined", "right",
          "wrong",     "looks_equal", "status",      "within",     "translation",
          "rotation",  "joint_error", "worst_joint", "evidence",   "evidence_of_truth",
          "explained", "belief",      "seconds"};
}

void add_foreign_rows(Table& table, std::uint64_t piece, const std::string& kind,
                      const ForeignResult& result) {
  for (std::size_t i = 0; i < result.frames.size(); ++i) {
    const ForeignFrame& frame = result.frames[i];
    const FrameOutcome& outcome = frame.errors.outcome;
    table.add({piece,
               i,
               kind,
               result.parts,
               result.view.open,
               result.view.placement,
               result.view.is_oblique ? "oblique" : "frontal",
               result.sensor,
               result.determined ? 1 : 0,
               frame.is_right() ? 1 : 0,
               frame.errors.wrong,
               frame.looks_equal ? 1 : 0,
               to_string(outcome.status),
               outcome.is_right() ? 1 : 0,
               outcome.translation,
               outcome.rotation,
               outcome.joints,
               outcome.worst_joint,
               frame.evidence,
               frame.evidence_of_truth,
               frame.explained,
               frame.belief,
               frame.seconds});
  }
}

Table read_foreign_rows(const std::vector<std::filesystem::path>& files) {
  std::map<std::pair<double, double>, Row> by_frame;
  for (const auto& file : files) {
    const Table part = read_table(file, foreign_columns());
    for (const Row& row : part.rows()) {
      by_frame.insert_or_assign({part.number(row, "piece"), part.number(row, "frame")}, row);
    }
  }
  Table table(foreign_columns());
  for (const auto& [frame, row] : by_frame) table.add(row);
  return table;
}

void print_foreign_report(const std::string& title, const Table& table) {
  std::map<Verdict, std::size_t> counts;
  std::vector<double> seconds;
  StatusCount statuses;
  std::vector<Row> wrong;
  for (const Row& row : table.rows()) {
    const Verdict is = verdict(table, row);
    ++counts[is];
    seconds.push_back(table.number(row, "seconds"));
    const bool is_within = table.number(row, "within") != 0.0;
    const bool tracking = is_trusted(table, row);
    // What a view does not determine may well be called uncertain.
    if (is == Verdict::right || is == Verdict::wrong || (is == Verdict::undetermined && tracking)) {
      statuses.add(tracking, is_within);
    }
    const bool is_wrongly_trusted = tracking && !is_within && is != Verdict::looks_equal;
    if (is == Verdict::wrong || is_wrongly_trusted) wrong.push_back(row);
  }
  const std::size_t compared = counts[Verdict::right] + counts[Verdict::wrong];
  const auto percent = [](std::size_t part, std::size_t of) {
    return of == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(of);
  };
  const Statistics times = summarize(seconds);
  std::cout << std::fixed << std::setprecision(1) << title << ": right in "
            << counts[Verdict::right] << " of " << compared << " views ("
            << percent(counts[Verdict::right], compared)
            << " %)\n  left out: " << counts[Verdict::looks_equal] << " of " << table.rows().size()
            << " (" << percent(counts[Verdict::looks_equal], table.rows().size())
            << " %), where something else looks the same as the truth; "
            << counts[Verdict::undetermined] << " that do not determine the base\n"
            << std::setprecision(2) << "  time: median " << times.median << " s, 95 % "
            << times.percentile_95 << " s, longest " << times.maximum << " s\n";
  for (const Row& row : wrong) print_wrong(table, row, ", " + table.word(row, "kind"));
  print_status_count(statuses);
}

Figure foreign_figure(const std::string& title, const Table& table) {
  std::map<double, std::pair<int, int>> by_parts;  // right, all
  std::vector<double> seconds;
  for (const Row& row : table.rows()) {
    seconds.push_back(table.number(row, "seconds"));
    const Verdict is = verdict(table, row);
    if (is != Verdict::right && is != Verdict::wrong) continue;
    auto& [right, all] = by_parts[table.number(row, "parts")];
    right += is == Verdict::right ? 1 : 0;
    ++all;
  }
  Curve rate{"right", {}, {}};
  for (const auto& [parts, counts] : by_parts) {
    rate.x.push_back(parts);
    rate.y.push_back(100.0 * counts.first / counts.second);
  }
  std::sort(seconds.begin(), seconds.end());
  Curve times{"views done", seconds, {}};
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    times.y.push_back(100.0 * static_cast<double>(i + 1) / static_cast<double>(seconds.size()));
  }
  return {title, {{"moving parts", "right (%)", {rate}}, {"time (s)", "views (%)", {times}}}};
}

}  // namespace lockbox::app
