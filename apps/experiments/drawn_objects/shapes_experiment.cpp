// SPDX-License-Identifier: BSD-3-Clause
// Round and free-form objects that nobody tuned for, found without a guess.
#include <iomanip>
#include <iostream>
#include <map>
#include <utility>

#include "answer_rows.hpp"
#include "command_line/interruption.hpp"
#include "drawn_objects_experiment.hpp"
#include "experiments/experiments.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/shapes_experiment.hpp"
#include "lockbox/evaluation/statistics.hpp"

namespace lockbox::app {
namespace {

std::vector<std::string> shape_columns() {
  return {"piece",       "kind",     "on_table", "covered",           "right",  "wrong",  "status",
          "translation", "rotation", "evidence", "evidence_of_truth", "belief", "seconds"};
}

void add_row(Table& table, std::uint64_t piece, const ShapeResult& result) {
  const FrameOutcome& outcome = result.errors.outcome;
  table.add({piece, result.kind, result.on_table ? 1 : 0, result.is_covered ? 1 : 0,
             result.is_right() ? 1 : 0, result.errors.wrong, to_string(outcome.status),
             outcome.translation, outcome.rotation, result.evidence, result.evidence_of_truth,
             result.belief, result.seconds});
}

/// Right ones, and all.
using Share = std::pair<int, int>;

void print_report(const std::string& title, const Table& table) {
  std::map<std::string, Share> shares;
  std::vector<double> seconds;
  Share all{0, 0};
  int trusted = 0;
  int trusted_wrongly = 0;
  for (const Row& row : table.rows()) {
    const int right = table.number(row, "right") != 0.0 ? 1 : 0;
    const auto count = [right](Share& share) {
      share.first += right;
      ++share.second;
    };
    count(all);
    count(shares[table.word(row, "kind")]);
    count(shares[table.number(row, "on_table") != 0.0 ? "on a table" : "in the air"]);
    count(shares[table.number(row, "covered") != 0.0 ? "a third hidden" : "not hidden"]);
    trusted += is_trusted(table, row) ? 1 : 0;
    trusted_wrongly += is_trusted(table, row) && right == 0 ? 1 : 0;
    seconds.push_back(table.number(row, "seconds"));
  }
  std::cout << title << ": right in " << all.first << " of " << all.second << " scenes; " << trusted
            << " trusted, " << trusted_wrongly << " of them wrongly\n";
  for (const auto& [what, share] : shares) {
    std::cout << "  " << what << ": " << share.first << " of " << share.second << '\n';
  }
  const Statistics times = summarize(seconds);
  std::cout << std::fixed << std::setprecision(2) << "  time: median " << times.median
            << " s, 95 % " << times.percentile_95 << " s, longest " << times.maximum << " s\n";
  for (const Row& row : table.rows()) {
    if (table.number(row, "right") == 0.0) print_wrong(table, row, ", " + table.word(row, "kind"));
  }
}

/// Returns the rows of all shards, each piece once.
Table all_rows(const std::filesystem::path& stem) {
  std::map<double, Row> by_piece;
  for (const auto& file : rows_files(stem)) {
    const Table part = read_table(file, shape_columns());
    for (const Row& row : part.rows()) by_piece.insert_or_assign(part.number(row, "piece"), row);
  }
  Table table(shape_columns());
  for (const auto& [piece, row] : by_piece) table.add(row);
  return table;
}

class Shapes : public DrawnObjectsExperiment {
 public:
  Shapes() : DrawnObjectsExperiment(40) {}

 private:
  std::string name() const override { return "shapes"; }
  std::vector<std::string> columns() const override { return shape_columns(); }
  std::string variant(const ExperimentSettings& settings) const override {
    return settings.sensor + "_";
  }

  std::string run_piece(const ObjectBlock& block, std::uint64_t piece,
                        const std::filesystem::path& folder, const ExperimentSettings& settings,
                        Table& table) const override {
    const ShapeResult result =
        search_shape(block, piece, piece_settings(settings, folder), interruption::executor());
    add_row(table, piece, result);
    return result.is_right() ? "" : result.errors.wrong;
  }

  void report(const std::filesystem::path& stem) const override {
    print_report("shapes, " + block(), all_rows(stem));
  }

  static ShapeSettings piece_settings(const ExperimentSettings& settings,
                                      const std::filesystem::path& folder) {
    ShapeSettings result;
    result.sensor = sensor_model(settings.sensor);
    result.camera = result.sensor.camera;
    result.seed = settings.seed;
    result.folder = folder;
    result.stop_request = interruption::requested;
    return result;
  }
};

}  // namespace

std::unique_ptr<Experiment> make_shapes_experiment() {
  return std::make_unique<Shapes>();
}

}  // namespace lockbox::app
