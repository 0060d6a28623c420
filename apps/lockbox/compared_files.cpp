// SPDX-License-Identifier: BSD-3-Clause
#include "compared_files.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "evaluation_tree.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/evaluation/matching_stamps.hpp"
#include "lockbox/evaluation/tum_trajectory.hpp"
#include "plausible_states.hpp"
#include "symmetry_note.hpp"

namespace lockbox::app {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text.empty() ? "none" : text;
}

/// Joints of the file, by its header, that the tree has not.
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
StatesFile read_reference(const std::string& file, const KinematicTree& tree,
                          const Remarks& remarks) try {
  StatesFile reference = read_states(file, tree);
  const auto foreign = foreign_joints(file, tree);
  if (!foreign.empty()) {
    remarks.warn(file + " has joints that the model of the estimate has not: " + listed(foreign) +
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

KinematicTree tree_without_joints() {
  KinematicTree tree;
  tree.bodies.resize(1);
  return tree;
}

KinematicTree tree_of(const ArticulatedModel* model, const std::string& estimate,
                      const Remarks& remarks) {
  if (model) return model->tree;
  KinematicTree tree = tree_of_columns(estimate);
  if (!tree.joints.empty()) {
    remarks.warn(
        "the model is not known (--model): all joints are taken for angles, the distances of "
        "sliding ones, too");
  }
  return tree;
}

/// Where joints move, turning the whole does not leave it as it looks.
EqualPoses equal_poses(const ArticulatedModel& model, const Remarks& remarks) {
  EqualPoses equal(model);
  if (!equal.any()) return equal;
  const bool is_rigid = model.tree.variables() == 0;
  remarks.note(symmetry_text(model.tree, equal) +
               (is_rigid ? ": errors are those from the nearest of these poses"
                         : ": an estimate that is turned so counts as wrong"));
  return is_rigid ? equal : EqualPoses();
}

}  // namespace

void require_comparable(const std::string& estimate, const std::string& reference) {
  for (const auto& file : {estimate, reference}) {
    if (!std::filesystem::exists(file)) throw InputError(file, "there is no such file");
  }
  if (is_tum_trajectory(estimate)) {
    throw InputError(estimate, "is a TUM trajectory; give the states.csv that stands beside it");
  }
}

ComparedFiles read_compared_files(const std::string& estimate, const std::string& reference,
                                  const ArticulatedModel* model, const Remarks& remarks) {
  const bool base_only = is_tum_trajectory(reference);
  ComparedFiles files;
  files.tree = base_only ? tree_without_joints() : tree_of(model, estimate, remarks);
  files.estimate = read_states(estimate, files.tree);
  require_increasing_stamps(estimate, files.estimate.states);
  files.reference =
      base_only ? read_tum_trajectory(reference) : read_reference(reference, files.tree, remarks);
  for (const auto& remark : match_stamps(files.estimate, files.reference, reference)) {
    remarks.warn(remark);
  }
  if (base_only) {
    remarks.note(reference + " is a TUM trajectory: joints are not compared");
    files.reference = at_times_of(files.estimate, files.reference);
  }
  require_increasing_stamps(reference, files.reference.states);
  if (model) files.equal = equal_poses(*model, remarks);
  return files;
}

}  // namespace lockbox::app
