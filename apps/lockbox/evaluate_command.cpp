// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <vector>

#include "commands.hpp"
#include "counted.hpp"
#include "evaluation_tree.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/matching_stamps.hpp"
#include "lockbox/evaluation/metrics.hpp"
#include "lockbox/evaluation/report.hpp"
#include "lockbox/evaluation/tum_trajectory.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "model_options.hpp"
#include "option_checks.hpp"
#include "output_paths.hpp"
#include "plausible_states.hpp"
#include "progress.hpp"
#include "symmetry_note.hpp"

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
  const JudgementCount& judgement = evaluation.judgement;
  std::cout << judgement.tracking << " of " << counted(evaluation.frames.size(), "frame")
            << " tracked, of these wrong: " << judgement.tracking_but_wrong
            << "; right but not called tracking: " << judgement.right_but_not_tracking
            << "; without an estimate near in time: " << evaluation.unmatched << '\n';
}

void warn(const std::string& text) {
  std::cerr << "lockbox: warning: " << text << '\n';
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text.empty() ? "none" : text;
}

/// Joints of the file, judged by its header, that the tree has not.
std::vector<std::string> foreign_joints(const std::string& file, const KinematicTree& tree) {
  std::vector<std::string> names;
  for (const Joint& found : tree_of_columns(file).joints) {
    if (std::none_of(tree.joints.begin(), tree.joints.end(),
                     [&found](const Joint& joint) { return joint.name == found.name; })) {
      names.push_back(found.name);
    }
  }
  return names;
}

/// The reference, or what is wrong about it, also if it belongs to another model.
StatesFile read_reference(const std::string& file, const KinematicTree& tree) try {
  StatesFile reference = read_states(file, tree);
  const auto foreign = foreign_joints(file, tree);
  if (!foreign.empty()) {
    warn(file + " has joints that the model of the estimate has not: " + listed(foreign) +
         "; is it the truth of another model?");
  }
  return reference;
} catch (const InputError& error) {
  const auto foreign = foreign_joints(file, tree);
  if (foreign.empty()) throw;
  std::vector<std::string> own;
  for (const Joint& joint : tree.joints) own.push_back(joint.name);
  throw InputError(std::string(error.what()) + "\n" + file,
                   "is it the truth of another model? Its joints are " + listed(foreign) +
                       ", those of the estimate's model " + listed(own));
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
    for (const auto& file : {estimate_, reference_}) {
      if (!std::filesystem::exists(file)) throw InputError(file, "there is no such file");
    }
    if (is_tum_trajectory(estimate_)) {
      throw InputError(estimate_, "is a TUM trajectory; give the states.csv that stands beside it");
    }
    const bool base_only = is_tum_trajectory(reference_);
    const std::optional<ArticulatedModel> model = known_model();
    const KinematicTree tree = base_only ? tree_without_joints() : tree_of(model);
    std::optional<std::vector<FrameBound>> bounds;
    if (!bounds_.empty()) bounds = read_bounds(bounds_, tree);
    StatesFile estimate = read_states(estimate_, tree);
    StatesFile reference =
        base_only ? read_tum_trajectory(reference_) : read_reference(reference_, tree);
    for (const auto& remark : match_stamps(estimate, reference, reference_)) warn(remark);
    if (base_only) {
      std::cerr << "lockbox: " << reference_ << " is a TUM trajectory: joints are not compared\n";
      reference = at_times_of(estimate, reference);
    }
    const Evaluation evaluation =
        evaluate(tree, estimate, reference, bounds, {}, model ? equal_poses(*model) : EqualPoses());
    print_evaluation(tree, evaluation);
    warn_of_reference(implausibility(tree, reference.states), evaluation.judgement);
    if (!output_.empty()) write_files(tree, evaluation);
    return ExitStatus::done;
  }

 private:
  std::optional<ArticulatedModel> known_model() const {
    const Activity activity("loading the model");
    if (model_.is_given()) return model_.load();
    return model_of_run(estimate_, model_.load_options());
  }

  KinematicTree tree_of(const std::optional<ArticulatedModel>& model) const {
    if (model) return model->tree;
    KinematicTree tree = tree_of_columns(estimate_);
    if (!tree.joints.empty()) {
      std::cerr << "lockbox: warning: the model is not known (--model): all joints are taken for "
                   "angles, the distances of sliding ones, too\n";
    }
    return tree;
  }

  /// Those that count as the true one. Where joints move, turning the whole does not leave it as
  /// it looks.
  static EqualPoses equal_poses(const ArticulatedModel& model) {
    EqualPoses equal(model);
    if (!equal.any()) return equal;
    const bool is_rigid = model.tree.variables() == 0;
    std::cerr << "lockbox: " << symmetry_text(model.tree, equal)
              << (is_rigid ? ": errors are those from the nearest of these poses\n"
                           : ": an estimate that is turned so counts as wrong\n");
    return is_rigid ? equal : EqualPoses();
  }

  static KinematicTree tree_without_joints() {
    KinematicTree tree;
    tree.bodies.resize(1);
    return tree;
  }

  void warn_of_reference(const std::string& implausible, const JudgementCount& judgement) const {
    constexpr std::size_t kSuspicious = 10;  // frames: so many are not wrong by chance
    if (!implausible.empty()) {
      warn(reference_ + ": " + implausible);
    } else if (judgement.tracking >= kSuspicious &&
               judgement.tracking_but_wrong == judgement.tracking) {
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
