// SPDX-License-Identifier: BSD-3-Clause
#include <iomanip>
#include <iostream>
#include <numbers>

#include "collision_experiment.hpp"
#include "commands.hpp"
#include "lockbox/evaluation/figure.hpp"
#include "parameters.hpp"
#include "shipped_files.hpp"

namespace lockbox::app {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kMillimetres = 1000.0;

/// One line an unknown, one column a mode.
void print_errors(const KinematicTree& tree, const std::vector<CollisionRun>& runs) {
  std::cout << '\n' << std::left << std::setw(36) << (tree.name + ", RMSE") << std::right;
  for (const auto& run : runs) std::cout << std::setw(12) << collision_mode_text(run.mode);
  std::cout << std::setw(34) << "largest |error| / sigma, literal\n"
            << std::fixed << std::setprecision(3);
  const auto row = [&](const std::string& name, const std::string& unit, auto&& value) {
    std::cout << std::left << std::setw(26) << name << std::setw(10) << unit << std::right;
    for (const auto& run : runs) std::cout << std::setw(12) << value(run.evaluation);
  };
  row("base translation", "mm",
      [](const Evaluation& e) { return kMillimetres * e.translation.rmse; });
  std::cout << '\n';
  row("base rotation", "degrees", [](const Evaluation& e) { return kDegrees * e.rotation.rmse; });
  std::cout << '\n';
  for (std::size_t i = 0; i < runs.front().evaluation.joints.size(); ++i) {
    const auto index = static_cast<std::size_t>(runs.front().evaluation.joints[i].joint);
    const bool slides = tree.joints[index].type == JointType::prismatic;
    const double scale = slides ? kMillimetres : kDegrees;
    row(tree.joints[index].name, slides ? "mm" : "degrees",
        [&](const Evaluation& e) { return scale * e.joints[i].errors.rmse; });
    for (const auto& run : runs) {
      if (run.mode == CollisionMode::literal) {
        std::cout << std::setw(33) << run.largest_normalized_error[index];
      }
    }
    std::cout << '\n';
  }
}

/// One panel a joint, one curve a mode: the joint's error over time.
Figure error_figure(const KinematicTree& tree, const std::vector<CollisionRun>& runs) {
  Figure figure;
  figure.title = tree.name + ": joint errors by collision term";
  for (const int joint : tree.file_order) {
    const auto index = static_cast<std::size_t>(joint);
    const bool slides = tree.joints[index].type == JointType::prismatic;
    Panel panel;
    panel.x_label = "time (s)";
    panel.y_label = tree.joints[index].name + (slides ? " (mm)" : " (degrees)");
    for (const auto& run : runs) {
      Curve curve;
      curve.name = collision_mode_text(run.mode);
      for (const auto& frame : run.evaluation.frames) {
        curve.x.push_back(frame.stamp);
        curve.y.push_back((slides ? kMillimetres : kDegrees) * frame.joints(joint));
      }
      panel.curves.push_back(curve);
    }
    figure.panels.push_back(panel);
  }
  return figure;
}

class ExperimentCommand : public Command {
 public:
  void add_options(CLI::App& options) override {
    options.add_option("name", name_, "collision")
        ->required()
        ->type_name("NAME")
        ->check(CLI::IsMember({"collision"}));
    options
        .add_option("-m,--model", models_, "Models to run (repeatable): files, or shipped names")
        ->type_name("FILE")
        ->default_str("lockbox lockbox_overlapping");
    options.add_option("-o,--output", output_, "Folder for raw results and figures")
        ->required()
        ->type_name("DIR");
    options.add_option("--frames", experiment_.frames, "Frames of each run")
        ->check(CLI::PositiveNumber);
    options.add_option("--sensor", experiment_.sensor,
                       "primesense, primesense-quiet, white or ideal");
    options.add_option("--seed", experiment_.seed, "Of the sensor's noise");
    options.add_option("--scene", scene_, "Scene file, or the name of a shipped scene")
        ->type_name("FILE");
    options.add_flag("-q,--quiet", experiment_.quiet, "No progress");
  }

  ExitStatus run() override {
    experiment_.scene = read_scene(find_scene(scene_));
    std::filesystem::create_directories(output_);
    for (const auto& name : models_) {
      const ArticulatedModel model = load_model(find_model(name));
      const auto runs = run_collision_experiment(model, experiment_);
      print_errors(model.tree, runs);
      const auto stem = output_ / ("collision_" + model.tree.name);
      write_collision_runs(stem.string() + ".csv", model.tree, runs);
      const std::string hindrance = write_figure(stem, error_figure(model.tree, runs));
      if (!hindrance.empty()) std::cerr << "lockbox: no figure: " << hindrance << '\n';
    }
    std::cout << "\nwritten: " << output_.string() << '\n';
    return ExitStatus::done;
  }

 private:
  std::string name_;
  std::vector<std::string> models_ = {"lockbox", "lockbox_overlapping"};
  std::filesystem::path output_;
  std::string scene_ = "room";
  CollisionExperiment experiment_;
};

}  // namespace

std::unique_ptr<Command> make_experiment_command() {
  return std::make_unique<ExperimentCommand>();
}

}  // namespace lockbox::app
