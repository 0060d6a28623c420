// SPDX-License-Identifier: BSD-3-Clause
// Random furniture, puzzle boards and things of a household that nobody tuned for, found without a
// guess.
#include "command_line/interruption.hpp"
#include "command_line/option_checks.hpp"
#include "drawn_objects_experiment.hpp"
#include "experiments/experiments.hpp"
#include "foreign_report.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox::app {
namespace {

class ForeignObjects : public DrawnObjectsExperiment {
 public:
  explicit ForeignObjects(DrawnKind kind) : DrawnObjectsExperiment(200), kind_(kind) {}

  void add_options(CLI::App& options) override {
    DrawnObjectsExperiment::add_options(options);
    options
        .add_option("--deviation", deviation_,
                    "none, or a third of every moderate deviation (see mismatch)")
        ->check(one_of({"none", "third"}));
    options.add_option("--frames", frames_, "Of each piece, which stands still")->check(positive());
    options.add_flag(
        "--tell-sensor", tells_sensor_,
        "Tell the tracker the sensor's profile (track --sensor); else it finds the noise out from "
        "the images");
    options
        .add_option("--downscale", downscale_,
                    "Images have so many times fewer columns and rows; in pixels, the sensor errs "
                    "as before")
        ->check(CLI::Range(1, 4));
    options
        .add_option("--size", size_,
                    "Objects are so many times as large, and so many times as far away")
        ->check(CLI::Range(0.2, 5.0));
  }

 private:
  std::string name() const override {
    switch (kind_) {
      case DrawnKind::furniture:
        return "furniture";
      case DrawnKind::board:
        return "boards";
      case DrawnKind::household:
        return "household";
    }
    return {};
  }
  /// Returns the noun of a row's object. Pieces of furniture and boards are numbered; the others
  /// have names.
  std::string noun(const ForeignResult& result) const {
    if (kind_ == DrawnKind::household) return result.object;
    return kind_ == DrawnKind::furniture ? "furniture" : "board";
  }
  std::vector<std::string> columns() const override { return foreign_columns(); }

  std::string variant(const ExperimentSettings& settings) const override {
    return deviation_ + "_" + (settings.sensor_is_given ? settings.sensor + "_" : "") +
           (tells_sensor_ ? "told_" : "") +
           (downscale_ > 1 ? "downscale" + std::to_string(downscale_) + "_" : "") +
           (size_ != 1.0 ? "size" + number_text(size_) + "_" : "") + std::to_string(frames_) +
           "frames_";
  }

  std::string run_piece(const ObjectBlock& block, std::uint64_t piece,
                        const std::filesystem::path& folder, const ExperimentSettings& settings,
                        Table& table) const override {
    const ForeignResult result = track_foreign_object(
        kind_, block, piece, piece_settings(settings, folder), interruption::executor());
    add_foreign_rows(table, piece, noun(result), result);
    return result.frames.back().errors.wrong;
  }

  void report(const std::filesystem::path& stem) const override {
    const Table all = read_foreign_rows(rows_files(stem));
    const std::string title = name() + ", " + block() + ", deviation " + deviation_;
    print_foreign_report(title, all);
    draw(stem, foreign_figure(title, all));
  }

  ForeignSettings piece_settings(const ExperimentSettings& settings,
                                 const std::filesystem::path& folder) const {
    ForeignSettings result;
    result.camera = sensor_model(settings.sensor).camera;
    result.downscale = downscale_;
    result.size = size_;
    if (settings.sensor_is_given) result.sensor = settings.sensor;
    result.tells_sensor = tells_sensor_;
    result.seed = settings.seed;
    result.deviates = deviation_ == "third";
    result.frames = frames_;
    result.folder = folder;
    result.stop_request = interruption::requested;
    return result;
  }

  DrawnKind kind_;
  std::string deviation_ = "none";
  int frames_ = 1;
  bool tells_sensor_ = false;
  int downscale_ = 1;
  double size_ = 1.0;
};

}  // namespace

std::unique_ptr<Experiment> make_furniture_experiment() {
  return std::make_unique<ForeignObjects>(DrawnKind::furniture);
}

std::unique_ptr<Experiment> make_boards_experiment() {
  return std::make_unique<ForeignObjects>(DrawnKind::board);
}

std::unique_ptr<Experiment> make_household_experiment() {
  return std::make_unique<ForeignObjects>(DrawnKind::household);
}

}  // namespace lockbox::app
