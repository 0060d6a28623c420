// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>

#include "../lockbox/evaluation_tree.hpp"
#include "bindings.hpp"
#include "calls.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/evaluation/matching_stamps.hpp"
#include "lockbox/evaluation/metrics.hpp"
#include "lockbox/evaluation/report.hpp"
#include "lockbox/evaluation/tum_trajectory.hpp"

namespace lockbox::python {
namespace {

KinematicTree rigid_tree() {
  KinematicTree tree;
  tree.bodies.resize(1);
  return tree;
}

KinematicTree tree_of(const std::string& estimate, const ModelPointer& model) {
  return model ? model->tree : app::tree_of_columns(estimate);
}

/// The text of summary.json. Remarks go into warnings.
std::string summary(const std::string& estimate_file, const std::string& reference_file,
                    const ModelPointer& model, Warnings& warnings) {
  for (const auto& file : {estimate_file, reference_file}) {
    if (!std::filesystem::exists(file)) throw InputError(file, "there is no such file");
  }
  const bool base_only = is_tum_trajectory(reference_file);
  const KinematicTree tree = base_only ? rigid_tree() : tree_of(estimate_file, model);
  StatesFile estimate = read_states(estimate_file, tree);
  StatesFile reference =
      base_only ? read_tum_trajectory(reference_file) : read_states(reference_file, tree);
  for (const auto& remark : match_stamps(estimate, reference, reference_file)) warnings.add(remark);
  if (base_only) reference = at_times_of(estimate, reference);
  const bool is_rigid = model && model->tree.variables() == 0;
  return summary_text(tree, evaluate(tree, estimate, reference, std::nullopt, {},
                                     is_rigid ? EqualPoses(*model) : EqualPoses()));
}

py::object evaluate_files(const std::filesystem::path& estimate,
                          const std::filesystem::path& reference,
                          const std::optional<Model>& model) {
  Warnings warnings;
  std::string text;
  {
    const py::gil_scoped_release others_go_on;
    ModelPointer known = model ? model->model : nullptr;
    if (!model) {
      if (auto of_run = app::model_of_run(estimate, {})) {
        known = std::make_shared<const ArticulatedModel>(std::move(*of_run));
      }
    }
    text = summary(estimate.string(), reference.string(), known, warnings);
  }
  warnings.issue();
  return py::module_::import("json").attr("loads")(text);
}

}  // namespace

void bind_evaluation(py::module_& module) {
  module.def(
      "evaluate", &evaluate_files, py::arg("estimate"), py::arg("reference"),
      py::arg("model") = py::none(),
      "Compares a states file with another, or with a TUM trajectory (of the base only). "
      "Returns what `lockbox evaluate` writes into summary.json: metres, radians, seconds; "
      "None where there is nothing to sum. model: by default that of the run.yaml beside the "
      "estimate; without either all joints are taken for angles. Raises InputError.");
}

}  // namespace lockbox::python
