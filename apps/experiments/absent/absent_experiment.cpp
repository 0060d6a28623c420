// SPDX-License-Identifier: BSD-3-Clause
// Rooms without the object, simulated and recorded: nothing in them may be taken for it.
#include <algorithm>
#include <set>

#include "absent_report.hpp"
#include "absent_runs.hpp"
#include "command_line/interruption.hpp"
#include "command_line/option_checks.hpp"
#include "command_line/progress.hpp"
#include "command_line/shipped_files.hpp"
#include "experiments/experiments.hpp"
#include "experiments/shard.hpp"
#include "lockbox/evaluation/absent_room.hpp"

namespace lockbox::app {
namespace {

/// Shipped models, one line for each object: all of a line show the same one, or contain it.
const std::vector<std::vector<std::string>>& shipped_objects() {
  static const std::vector<std::vector<std::string>> objects = {{"board_door_block"},
                                                                {"cabinet"},
                                                                {"carton", "carton_pair"},
                                                                {"lockbox", "lockbox_overlapping"},
                                                                {"rigid_block"}};
  return objects;
}

std::vector<ArticulatedModel> load_others(const std::string& model, bool quiet) {
  const Activity activity("loading other models", quiet);
  std::vector<ArticulatedModel> others;
  for (const auto& object : shipped_objects()) {
    if (std::find(object.begin(), object.end(), model) != object.end()) continue;
    others.push_back(load_model(find_model(object.front())));
  }
  return others;
}

class Absent : public Experiment {
 public:
  bool continues() const override { return true; }

  void add_options(CLI::App& options) override {
    options.add_option("--rooms", rooms_, "Number of simulated rooms")->check(not_negative());
    options
        .add_option("--near-misses", near_misses_,
                    "Number of rooms with the object larger, or without one of its parts")
        ->check(not_negative());
    options.add_option("--frames", frames_, "Of each room")->check(positive());
    options
        .add_option("--recording", recordings_,
                    "A recording of a room without the object, or a folder of such (repeatable)")
        ->type_name("SOURCE");
    options.add_option("--max-frames", max_frames_, "Of each recording")->check(positive());
    shard_.add_to(options);
  }

 private:
  std::vector<std::string> default_models() const override {
    return {"lockbox", "cabinet", "rigid_block", "board_door_block"};
  }

  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    const auto stem =
        settings.output / ("absent_" + model.tree.name + "_" + settings.sensor + "_" +
                           std::to_string(frames_) + "frames_seed" + std::to_string(settings.seed));
    const auto recorded_stem = settings.output / ("absent_" + model.tree.name + "_recorded_" +
                                                  std::to_string(max_frames_) + "frames");
    const auto others = load_others(model.tree.name, settings.quiet);
    std::vector<const ArticulatedModel*> other_models;
    other_models.reserve(others.size());
    for (const ArticulatedModel& other : others) other_models.push_back(&other);
    const SensorModel sensor = sensor_model(settings.sensor);
    const AbsentRooms rooms(model, other_models, sensor.camera, settings.seed,
                            interruption::executor());
    const Interruption interruption;
    const auto run = [&](const std::filesystem::path& part,
                         const std::vector<PlannedAbsentRun>& runs) {
      return run_all(model, part, runs, interruption, settings.quiet);
    };
    const AbsentPlan plan{rooms_, near_misses_, frames_, sensor, settings.seed};
    const bool finished =
        run(stem, simulated_runs(rooms, plan)) &&
        run(recorded_stem, recorded_runs(recordings_, static_cast<std::size_t>(max_frames_)));
    auto files = rows_files(stem);
    for (const auto& file : rows_files(recorded_stem)) files.push_back(file);
    draw(stem, report_absent(model.tree.name, files));
    return finished;
  }

  /// Runs those that have no rows yet; each is written as it is done. Returns false if interrupted.
  bool run_all(const ArticulatedModel& model, const std::filesystem::path& stem,
               const std::vector<PlannedAbsentRun>& runs, const Interruption& interruption,
               bool quiet) const {
    if (runs.empty()) return true;
    const auto file = shard_.rows_file(stem);
    Table table = continued_table(file, absent_columns());
    std::set<std::string> done;
    for (const Row& row : table.rows()) done.insert(run_of(table, row));
    Progress progress(stem.filename().string(), shard_.runs_of(runs.size()), quiet, "rooms");
    std::size_t finished = 0;
    for (std::size_t i = 0; i < runs.size() && !interruption.requested(); ++i) {
      if (!shard_.holds(i)) continue;
      progress.update(finished++, runs[i].text);
      if (done.count(runs[i].text) > 0) continue;
      if (!is_done([&] { track_absent(model, runs[i].open(), stem, table); })) break;
      write_table(file, table);
    }
    progress.finish();
    return !interruption.requested();
  }

  std::uint64_t rooms_ = 60;
  std::uint64_t near_misses_ = 20;
  int frames_ = 3;
  int max_frames_ = 100;
  std::vector<std::string> recordings_;
  Shard shard_;
};

}  // namespace

std::unique_ptr<Experiment> make_absent_experiment() {
  return std::make_unique<Absent>();
}

}  // namespace lockbox::app
