// SPDX-License-Identifier: BSD-3-Clause
// The same recording tracked with the same model, its links and joints written in another order and
// its links under other names.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "command_line/option_checks.hpp"
#include "command_line/progress.hpp"
#include "command_line/shipped_files.hpp"
#include "experiments/experiments.hpp"
#include "lockbox/evaluation/possible_motion.hpp"
#include "lockbox/evaluation/table.hpp"
#include "urdf_variant.hpp"

namespace lockbox::app {
namespace {

constexpr double kAllowedWhenRenamed = 1e-6;  // metres or radians

struct OrderRun {
  std::string variant;  ///< "reordered" or "renamed"
  int number = 0;
  std::vector<double> differences;  ///< by frame: the largest of pose and joints

  double largest() const { return *std::max_element(differences.begin(), differences.end()); }
};

/// The largest difference of any number; infinite if only one of the two is known.
double difference(const KinematicTree& tree, const Configuration& configuration,
                  const KinematicTree& other_tree, const Configuration& other) {
  std::vector<std::pair<double, double>> numbers;
  for (Eigen::Index i = 0; i < 16; ++i) {
    numbers.emplace_back(configuration.T_camera_base.data()[i], other.T_camera_base.data()[i]);
  }
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    numbers.emplace_back(
        joint_position(tree, configuration, static_cast<int>(j)),
        joint_position(other_tree, other, joint_index(other_tree, tree.joints[j].name)));
  }
  double largest = 0.0;
  for (const auto& [a, b] : numbers) {
    if (std::isnan(a) != std::isnan(b)) return INFINITY;
    if (!std::isnan(a)) largest = std::max(largest, std::abs(a - b));
  }
  return largest;
}

std::vector<TrackingResult> track_all(const ArticulatedModel& model, const Configuration& start,
                                      const KinematicTree& tree, const Recording& recording) {
  Tracker tracker(model, TrackerOptions{});
  Configuration own = rest_configuration(model.tree);
  own.T_camera_base = start.T_camera_base;
  for (const int joint : tree.variable_joint) {
    set_joint_position(model.tree, own, tree.joints[static_cast<std::size_t>(joint)].name,
                       joint_position(tree, start, joint));
  }
  tracker.start(own);
  return track(tracker, recording);
}

Table rows_of(const std::vector<OrderRun>& runs) {
  Table table({"variant", "run", "frame", "difference"});
  for (const OrderRun& run : runs) {
    for (std::size_t i = 0; i < run.differences.size(); ++i) {
      table.add({run.variant, run.number, i, run.differences[i]});
    }
  }
  return table;
}

void print_summary(const std::vector<OrderRun>& runs) {
  const auto print = [&](const std::string& variant, double allowed, const std::string& wanted) {
    int own = 0;
    int good = 0;
    double largest = 0.0;
    for (const OrderRun& run : runs) {
      if (run.variant != variant) continue;
      ++own;
      good += run.largest() <= allowed ? 1 : 0;
      largest = std::max(largest, run.largest());
    }
    std::cout << variant << ": " << wanted << " in " << good << " of " << own
              << " runs; largest difference " << largest << " (m, rad)\n";
  };
  std::cout << '\n';
  print("reordered", 0.0, "bit-identical");
  print("renamed", kAllowedWhenRenamed, "within 1e-6");
}

Figure difference_figure(const std::string& name, const std::vector<OrderRun>& runs) {
  Panel panel{"frame", "largest difference (1e-6 m, rad)", {}};
  for (const OrderRun& run : runs) {
    Curve curve{run.variant + " " + std::to_string(run.number), {}, {}};
    for (std::size_t i = 0; i < run.differences.size(); ++i) {
      curve.x.push_back(static_cast<double>(i));
      curve.y.push_back(1e6 * run.differences[i]);
    }
    panel.curves.push_back(curve);
  }
  return {name + ": links in another order, and under other names", {panel}};
}

class Order : public Experiment {
 public:
  void add_options(CLI::App& options) override {
    options.add_option("--runs", runs_, "Random orders, and as many renamings")->check(positive());
    options.add_option("--frames", frames_, "Of the recording")->check(between(2, 100000));
  }

 private:
  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    TrajectoryOptions trajectory;
    trajectory.frames = frames_;
    trajectory.T_camera_base = usual_view(model).T_camera_base;
    const Recording recording = simulate(model, possible_motion(model, trajectory),
                                         read_scene(find_scene("room")), settings);
    const Configuration& start = recording.truth.front().configuration;
    const auto reference = track_all(model, start, model.tree, recording);
    const auto stem = settings.output / ("order_" + model.tree.name);
    std::vector<OrderRun> runs;
    Progress progress("order " + model.tree.name, static_cast<std::size_t>(2 * runs_),
                      settings.quiet, "runs");
    for (const char* variant : {"reordered", "renamed"}) {
      for (int number = 0; number < runs_; ++number) {
        const auto urdf = stem / (variant + std::to_string(number)) / model.file.filename();
        write_urdf_variant(model.file, urdf, variant == std::string("renamed"), settings.seed,
                           static_cast<std::uint64_t>(number));
        const ArticulatedModel other = load_model(urdf);
        const auto results = track_all(other, start, model.tree, recording);
        OrderRun run{variant, number, {}};
        for (std::size_t i = 0; i < results.size(); ++i) {
          run.differences.push_back(difference(model.tree, reference[i].configuration, other.tree,
                                               results[i].configuration));
        }
        runs.push_back(run);
        progress.update(runs.size());
      }
    }
    progress.finish();
    print_summary(runs);
    write_table(stem.string() + ".csv", rows_of(runs));
    draw(stem, difference_figure(model.tree.name, runs));
    return true;
  }

  int runs_ = 10;
  int frames_ = 60;
};

}  // namespace

std::unique_ptr<Experiment> make_order_experiment() {
  return std::make_unique<Order>();
}

}  // namespace lockbox::app
