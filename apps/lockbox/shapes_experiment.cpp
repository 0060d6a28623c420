// SPDX-License-Identifier: BSD-3-Clause
// Round and free-form objects that nobody tuned for, found without a guess.
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>
#include <utility>

#include "experiments.hpp"
#include "interruption.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/shapes_experiment.hpp"
#include "lockbox/evaluation/statistics.hpp"
#include "lockbox/evaluation/table.hpp"
#include "option_checks.hpp"
#include "progress.hpp"
#include "shard.hpp"

namespace lockbox::app {
namespace {

std::vector<std::string> columns() {
  return {"piece",       "kind",     "on_table", "covered",           "right",  "wrong", "status",
          "translation", "rotation", "evidence", "evidence_of_truth", "seconds"};
}

void add_row(Table& table, std::uint64_t piece, const ShapeResult& result) {
  const FrameOutcome& outcome = result.errors.outcome;
  table.add({piece, result.kind, result.on_table ? 1 : 0, result.is_covered ? 1 : 0,
             result.is_right() ? 1 : 0, result.errors.wrong, to_string(outcome.status),
             outcome.translation, outcome.rotation, result.evidence, result.evidence_of_truth,
             result.seconds});
}

bool is_trusted(const Table& table, const Row& row) {
  return table.word(row, "status") == to_string(TrackingStatus::tracking);
}

void print_wrong(const Table& table, const Row& row) {
  std::cout << "  piece " << table.word(row, "piece") << ", " << table.word(row, "kind") << ": "
            << table.word(row, "wrong") << ", " << std::fixed << std::setprecision(0)
            << kMillimetres * table.number(row, "translation") << " mm, "
            << kDegrees * table.number(row, "rotation") << " degrees, " << table.word(row, "status")
            << "; evidence " << table.number(row, "evidence") << ", of the truth "
            << table.number(row, "evidence_of_truth") << '\n';
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
    if (table.number(row, "right") == 0.0) print_wrong(table, row);
  }
}

/// Of all shards.
Table all_rows(const std::filesystem::path& stem) {
  Table table(columns());
  for (const auto& file : rows_files(stem)) {
    const Table part = read_table(file, columns());
    for (const Row& row : part.rows()) table.add(row);
  }
  return table;
}

class Shapes : public Experiment {
 public:
  bool continues() const override { return true; }

  void add_options(CLI::App& options) override {
    options.add_option("--block", block_,
                       "tune, or test:<n>: which objects are drawn; a block that a change has "
                       "looked at is none for reports any more");
    options.add_option("--pieces", pieces_, "Of the block")->check(positive());
    shard_.add_to(options);
  }

  /// Draws its models itself.
  bool run(const ExperimentSettings& settings) override {
    if (!settings.models.empty()) {
      throw InputError("--model", "this experiment draws its objects itself; leave it out");
    }
    const ObjectBlock block(block_);
    const auto stem = settings.output / stem_name(settings);
    const auto file = shard_.rows_file(stem);
    Table table = continued_table(file, columns());
    std::set<std::uint64_t> done;
    for (const Row& row : table.rows()) {
      done.insert(static_cast<std::uint64_t>(table.number(row, "piece")));
    }
    const Interruption interruption;
    Progress progress("shapes", shard_.runs_of(pieces_), settings.quiet, "pieces");
    std::size_t finished = done.size();
    for (std::uint64_t piece = 0; piece < pieces_ && !interruption.requested(); ++piece) {
      if (!shard_.holds(piece) || done.count(piece) > 0) continue;
      ShapeResult result;
      const auto search = [&] {
        result = search_shape(block, piece, piece_settings(settings, stem / std::to_string(piece)),
                              Executor());
      };
      if (!is_done(search)) break;
      add_row(table, piece, result);
      write_table(file, table);
      progress.update(++finished, result.is_right() ? "right" : result.errors.wrong);
    }
    progress.finish();
    print_report("shapes, " + block_, all_rows(stem));
    return !interruption.requested();
  }

 private:
  /// Has none.
  bool run_model(const ArticulatedModel& /*model*/,
                 const ExperimentSettings& /*settings*/) override {
    return true;
  }

  std::string stem_name(const ExperimentSettings& settings) const {
    std::string block = block_;
    std::replace(block.begin(), block.end(), ':', '-');
    return "shapes_" + block + "_" + settings.sensor + "_seed" + std::to_string(settings.seed);
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

  std::string block_ = "tune";
  std::uint64_t pieces_ = 40;
  Shard shard_;
};

}  // namespace

std::unique_ptr<Experiment> make_shapes_experiment() {
  return std::make_unique<Shapes>();
}

}  // namespace lockbox::app
