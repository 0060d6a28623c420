// SPDX-License-Identifier: BSD-3-Clause
// Random furniture and puzzle boards that nobody tuned for, found without a guess.
#include <algorithm>
#include <set>

#include "experiments.hpp"
#include "foreign_report.hpp"
#include "interruption.hpp"
#include "lockbox/core/error.hpp"
#include "option_checks.hpp"
#include "progress.hpp"
#include "shard.hpp"

namespace lockbox::app {
namespace {

class ForeignObjects : public Experiment {
 public:
  explicit ForeignObjects(DrawnKind kind) : kind_(kind) {}

  bool continues() const override { return true; }

  void add_options(CLI::App& options) override {
    options.add_option("--block", block_,
                       "tune, or test:<n>: which objects are drawn; a block that a change has "
                       "looked at is none for reports any more");
    options.add_option("--pieces", pieces_, "Of the block")->check(positive());
    options
        .add_option("--deviation", deviation_,
                    "none, or a third of every moderate deviation (see mismatch)")
        ->check(one_of({"none", "third"}));
    options.add_option("--frames", frames_, "Of each piece, which stands still")->check(positive());
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
    Table table(foreign_columns());
    if (std::filesystem::exists(file)) table = read_table(file, foreign_columns());
    std::set<std::uint64_t> done;
    for (const Row& row : table.rows()) {
      done.insert(static_cast<std::uint64_t>(table.number(row, "piece")));
    }
    const Interruption interruption;
    Progress progress(name(), shard_.runs_of(pieces_), settings.quiet, "pieces");
    std::size_t finished = done.size();
    for (std::uint64_t piece = 0; piece < pieces_ && !interruption.requested(); ++piece) {
      if (!shard_.holds(piece) || done.count(piece) > 0) continue;
      ForeignResult result;
      const auto track_piece = [&] {
        result = track_foreign_object(kind_, block, piece,
                                      piece_settings(settings, stem / std::to_string(piece)),
                                      Executor());
      };
      if (!is_done(track_piece)) break;
      add_foreign_rows(table, piece, noun(), result);
      write_table(file, table);
      const AnswerErrors& errors = result.frames.back().errors;
      progress.update(++finished, errors.wrong.empty() ? "right" : errors.wrong);
    }
    progress.finish();
    const Table all = read_foreign_rows(rows_files(stem));
    const std::string title = name() + ", " + block_ + ", deviation " + deviation_;
    print_foreign_report(title, all);
    draw(stem, foreign_figure(title, all));
    return !interruption.requested();
  }

 private:
  /// Has none.
  bool run_model(const ArticulatedModel& /*model*/,
                 const ExperimentSettings& /*settings*/) override {
    return true;
  }

  std::string name() const { return kind_ == DrawnKind::furniture ? "furniture" : "boards"; }
  std::string noun() const { return kind_ == DrawnKind::furniture ? "furniture" : "board"; }

  std::string stem_name(const ExperimentSettings& settings) const {
    std::string block = block_;
    std::replace(block.begin(), block.end(), ':', '-');
    return name() + "_" + block + "_" + deviation_ + "_" +
           (settings.sensor_is_given ? settings.sensor + "_" : "") + std::to_string(frames_) +
           "frames_seed" + std::to_string(settings.seed);
  }

  ForeignSettings piece_settings(const ExperimentSettings& settings,
                                 const std::filesystem::path& folder) const {
    ForeignSettings result;
    result.camera = sensor_model(settings.sensor).camera;
    if (settings.sensor_is_given) result.sensor = settings.sensor;
    result.seed = settings.seed;
    result.deviates = deviation_ == "third";
    result.frames = frames_;
    result.folder = folder;
    result.stop_request = interruption::requested;
    return result;
  }

  DrawnKind kind_;
  std::string block_ = "tune";
  std::uint64_t pieces_ = 200;
  std::string deviation_ = "none";
  int frames_ = 1;
  Shard shard_;
};

}  // namespace

std::unique_ptr<Experiment> make_furniture_experiment() {
  return std::make_unique<ForeignObjects>(DrawnKind::furniture);
}

std::unique_ptr<Experiment> make_boards_experiment() {
  return std::make_unique<ForeignObjects>(DrawnKind::board);
}

}  // namespace lockbox::app
