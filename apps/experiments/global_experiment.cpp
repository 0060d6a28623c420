// SPDX-License-Identifier: BSD-3-Clause
#include <iomanip>
#include <iostream>
#include <map>
#include <set>

#include "command_line/interruption.hpp"
#include "command_line/option_checks.hpp"
#include "command_line/progress.hpp"
#include "experiments.hpp"
#include "lockbox/evaluation/global_experiment.hpp"
#include "lockbox/evaluation/statistics.hpp"
#include "shard.hpp"

namespace lockbox::app {
namespace {

std::vector<GlobalResult> rows_of_all_shards(const std::filesystem::path& stem) {
  std::map<std::uint64_t, GlobalResult> by_scene;
  for (const auto& file : rows_files(stem)) {
    for (const GlobalResult& row : read_global_results(file)) by_scene[row.scene] = row;
  }
  std::vector<GlobalResult> rows;
  rows.reserve(by_scene.size());
  for (const auto& [scene, row] : by_scene) rows.push_back(row);
  return rows;
}

void print_summary(const std::string& name, const std::vector<GlobalResult>& rows) {
  std::map<std::string, int> wrong;
  std::vector<double> seconds;
  StatusCount statuses;
  int counted = 0;
  int right = 0;
  for (const GlobalResult& row : rows) {
    seconds.push_back(row.seconds);
    const bool is_tracking = row.status == TrackingStatus::tracking;
    // What a scene does not determine may well be called uncertain.
    if (row.determined || is_tracking) statuses.add(is_tracking, row.within);
    if (!row.determined) continue;
    ++counted;
    right += row.right ? 1 : 0;
    if (!row.right) ++wrong[row.wrong];
  }
  if (counted == 0) return;
  const Statistics times = summarize(seconds);
  std::cout << std::fixed << std::setprecision(1) << name << ": right in " << right << " of "
            << counted << " scenes that determine the base (" << 100.0 * right / counted << " %), "
            << rows.size() - static_cast<std::size_t>(counted) << " further scenes\n"
            << std::setprecision(2) << "  time: median " << times.median << " s, 95 % "
            << times.percentile_95 << " s, longest " << times.maximum << " s\n";
  for (const auto& [what, count] : wrong) {
    std::cout << "  wrong " << count << " times: " << what << '\n';
  }
  print_status_count(statuses);
}

/// Right answers by distance, and how many scenes took at most so long.
Figure global_figure(const std::string& name, const std::vector<GlobalResult>& rows) {
  constexpr double kBin = 0.3;
  std::map<int, std::pair<int, int>> bins;  // right, all
  std::vector<double> seconds;
  for (const GlobalResult& row : rows) {
    seconds.push_back(row.seconds);
    if (!row.determined) continue;
    auto& [right, all] = bins[static_cast<int>(row.distance / kBin)];
    right += row.right ? 1 : 0;
    ++all;
  }
  Curve rate{"right", {}, {}};
  for (const auto& [bin, counts] : bins) {
    rate.x.push_back(kBin * (bin + 0.5));
    rate.y.push_back(100.0 * counts.first / counts.second);
  }
  return {name + ": found without a guess",
          {{"distance (m)", "right (%)", {rate}},
           {"time (s)", "scenes (%)", {cumulative_curve("scenes done", seconds)}}}};
}

class GlobalSearch : public Experiment {
 public:
  bool continues() const override { return true; }

  void add_options(CLI::App& options) override {
    options.add_option("--scenes", scenes_, "Number of random scenes")->check(positive());
    shard_.add_to(options);
  }

 private:
  std::vector<std::string> default_models() const override {
    return {"lockbox", "cabinet", "rigid_block"};
  }

  /// Searches the scenes that have no row yet; sums up the rows of all shards.
  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    const auto stem =
        settings.output / ("global_" + model.tree.name + "_seed" + std::to_string(settings.seed));
    const auto file = shard_.rows_file(stem);
    std::vector<GlobalResult> rows;
    if (std::filesystem::exists(file)) rows = read_global_results(file);
    std::set<std::uint64_t> done;
    for (const GlobalResult& row : rows) done.insert(row.scene);
    const SensorModel sensor = sensor_model(settings.sensor);
    GlobalExperiment experiment(model, sensor.camera, sensor, settings.seed,
                                interruption::executor(), interruption::requested);
    const Interruption interruption;
    Progress progress("global " + model.tree.name, shard_.runs_of(scenes_), settings.quiet,
                      "scenes");
    for (std::uint64_t scene = 0; scene < scenes_ && !interruption.requested(); ++scene) {
      if (!shard_.holds(scene) || done.count(scene) > 0) continue;
      if (!is_done([&] { rows.push_back(experiment.search_scene(scene)); })) break;
      write_global_results(file, rows);
      progress.update(rows.size(), rows.back().right ? "right" : rows.back().wrong);
    }
    progress.finish();
    const auto all = rows_of_all_shards(stem);
    print_summary(model.tree.name, all);
    draw(stem, global_figure(model.tree.name, all));
    return !interruption.requested();
  }

  std::uint64_t scenes_ = 500;
  Shard shard_;
};

}  // namespace

std::unique_ptr<Experiment> make_global_experiment() {
  return std::make_unique<GlobalSearch>();
}

}  // namespace lockbox::app
