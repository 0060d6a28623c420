// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>

#include "../lockbox/compared_files.hpp"
#include "../lockbox/evaluation_tree.hpp"
#include "bindings.hpp"
#include "calls.hpp"
#include "lockbox/evaluation/metrics.hpp"
#include "lockbox/evaluation/report.hpp"

namespace lockbox::python {
namespace {

ModelPointer model_of_run(const std::filesystem::path& estimate) {
  auto model = app::model_of_run(estimate, {});
  return model ? std::make_shared<const ArticulatedModel>(std::move(*model)) : nullptr;
}

py::object evaluate_files(const std::filesystem::path& estimate,
                          const std::filesystem::path& reference,
                          const std::optional<Model>& model) {
  Warnings warnings;
  std::string text;
  {
    const py::gil_scoped_release others_go_on;
    app::require_comparable(estimate.string(), reference.string());
    const auto of_run = model ? nullptr : model_of_run(estimate);
    const auto files = app::read_compared_files(
        estimate.string(), reference.string(), model ? model->model.get() : of_run.get(),
        {[&](const std::string& warning) { warnings.add(warning); }, [](const std::string&) {}});
    text = summary_text(files.tree, evaluate(files.tree, files.estimate, files.reference,
                                             std::nullopt, {}, files.equal));
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
