// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <vector>

#include "command_line/option_checks.hpp"
#include "command_line/output_paths.hpp"
#include "command_line/progress.hpp"
#include "commands.hpp"
#include "compared_files.hpp"
#include "counted.hpp"
#include "evaluation_tree.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/metrics.hpp"
#include "lockbox/evaluation/report.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "model_options.hpp"
#include "named_refusal.hpp"
#include "plausible_states.hpp"

namespace lockbox::app {
namespace {

void print_row(const std::string& name, const std::string& unit, double scale,
               const Statistics& errors) {
  std::cout << std::left << std::setw(28) << name << std::setw(8) << unit << std::right;
  for (const double value : {errors.rmse, errors.median, errors.percentile_95, errors.maximum}) {
    std::cout << std::setw(11) << scale * value;
  }
  std::cout << std::setw(9) << errors.count << '\n';
}

void print_evaluation(const KinematicTree& tree, const Evaluation& evaluation) {
  std::cout << std::fixed << std::setprecision(3) << std::left << std::setw(36) << "error"
            << std::right << std::setw(11) << "RMSE" << std::setw(11) << "median" << std::setw(11)
            << "95 %" << std::setw(11) << "maximum" << std::setw(9) << "frames\n";
  print_row("base translation", "mm", kMillimetres, evaluation.translation);
  print_row("base rotation", "degrees", kDegrees, evaluation.rotation);
  for (const auto& summary : evaluation.joints) {
    const Joint& joint = tree.joints[static_cast<std::size_t>(summary.joint)];
    const bool slides = joint.type == JointType::prismatic;
    print_row(joint.name, slides ? "mm" : "degrees", slides ? kMillimetres : kDegrees,
              summary.errors);
  }
  const StatusCount& statuses = evaluation.statuses;
  std::cout << statuses.tracking << " of " << counted(evaluation.frames.size(), "frame")
            << " tracked, of these wrong: " << statuses.tracking_but_wrong
            << "; right but not called tracking: " << statuses.right_but_not_tracking
            << "; without an estimate near in time: " << evaluation.unmatched << '\n';
}

void note(const std::string& text) {
  std::cerr << "lockbox: " << text << '\n';
}

void warn(const std::string& text) {
  note("warning: " + text);
}

class EvaluateCommand : public Command {
 public:
  void add_options(CLI::App& options) override {
    options.add_option("-e,--estimate", estimate_, "Estimated states (states.csv of a run)")
        ->required()
        ->type_name("FILE");
    options
        .add_option("-r,--reference", reference_,
                    "True states (groundtruth.csv), or a TUM trajectory: of the base only")
        ->required()
        ->type_name("FILE");
    options.add_option("-o,--output", output_, "Folder for summary.json, errors.csv and plots")
        ->check(folder_name())
        ->type_name("DIR");
    model_.add_optional_to(
        options, "The model, if no run.yaml beside the estimate names it: tells the joints' units");
    options
        .add_option("--bounds", bounds_,
                    "Bounds file: only unknowns that a frame determines count there")
        ->type_name("FILE");
  }

  ExitStatus run() override {
    require_comparable(estimate_, reference_);
    const std::optional<ArticulatedModel> model = known_model();
    const ComparedFiles files =
        read_compared_files(estimate_, reference_, model ? &*model : nullptr, {warn, note});
    std::optional<std::vector<FrameBound>> bounds;
    if (!bounds_.empty()) bounds = read_bounds(bounds_, files.tree);
    const Evaluation evaluation = refused_in(estimate_, [&] {
      return evaluate(files.tree, files.estimate, files.reference, bounds, {}, files.equal);
    });
    print_evaluation(files.tree, evaluation);
    warn_of_reference(implausibility(files.tree, files.reference.states), evaluation.statuses);
    if (!output_.empty()) write_files(files.tree, evaluation);
    return ExitStatus::done;
  }

 private:
  std::optional<ArticulatedModel> known_model() const {
    const Activity activity("loading the model");
    if (model_.is_given()) return model_.load();
    return model_of_run(estimate_, model_.load_options());
  }

  void warn_of_reference(const std::string& implausible, const StatusCount& statuses) const {
    constexpr std::size_t kSuspicious = 10;  // frames: so many are not wrong by chance
    if (!implausible.empty()) {
      warn(reference_ + ": " + implausible);
    } else if (statuses.tracking >= kSuspicious &&
               statuses.tracking_but_wrong == statuses.tracking) {
      warn("no frame that was tracked agrees with " + reference_ +
           "; is it the truth of this recording, with the pose of the base in the camera's frame?");
    }
  }

  void write_files(const KinematicTree& tree, const Evaluation& evaluation) const {
    make_folder(output_);
    write_summary(output_ / "summary.json", tree, evaluation);
    write_errors(output_ / "errors.csv", tree, evaluation);
    const std::string hindrance = write_error_plots(output_, tree, evaluation);
    if (!hindrance.empty()) std::cerr << "lockbox: no plots: " << hindrance << '\n';
    std::cout << "written: " << output_.string() << '\n';
  }

  std::string estimate_;
  std::string reference_;
  std::filesystem::path output_;
  ModelOptions model_;
  std::string bounds_;
};

}  // namespace

std::unique_ptr<Command> make_evaluate_command() {
  return std::make_unique<EvaluateCommand>();
}

}  // namespace lockbox::app
