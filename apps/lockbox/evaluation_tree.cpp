// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_tree.hpp"

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include "lockbox/core/csv_file.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/existing_path.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/yaml_value.hpp"

namespace lockbox::app {
namespace {

namespace fs = std::filesystem;

/// What a run says of itself; nothing if it cannot be read, or is no YAML.
std::optional<YamlValue> description_in(const fs::path& run) {
  if (!is_file(run)) return std::nullopt;
  try {
    return YamlValue::load(run, "run");
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// Nothing of somebody else's run.yaml: the columns of the states file have to do.
std::optional<fs::path> model_file_of(const YamlValue& run) {
  const auto model = run.find("model");
  if (!model || !model->is_plain() || !is_file(model->text())) return std::nullopt;
  return model->text();
}

/// Metres a unit of the model's meshes, if the run says so.
double mesh_scale_of(const YamlValue& run) {
  const auto options = run.find("options");
  const auto scale = options ? options->find("mesh-scale") : std::nullopt;
  if (!scale) return 1.0;
  const auto number = scale->is_plain() ? parse_finite_number(scale->text()) : std::nullopt;
  if (number && *number > 0.0) return *number;
  scale->refuse("'mesh-scale' must be a positive number: metres a unit of the mesh files");
}

/// The columns after the pose, up to `status`.
std::vector<std::string> joint_columns(const fs::path& states_file) {
  constexpr std::size_t kPoseColumns = 8;
  if (std::filesystem::is_directory(states_file)) {
    throw InputError(states_file.string(), "is a folder; give the states.csv, or the truth, in it");
  }
  const CsvFile csv(states_file);
  const std::vector<std::string_view>& columns = csv.columns();
  if (columns.size() == 1 && columns.front().empty()) throw InputError(csv.name(), "is empty");
  const auto status = std::find(columns.begin(), columns.end(), "status");
  const auto count = static_cast<std::size_t>(status - columns.begin());
  const auto first = columns.begin() + static_cast<std::ptrdiff_t>(std::min(kPoseColumns, count));
  return {first, status};
}

}  // namespace

std::optional<ArticulatedModel> model_of_run(const fs::path& states_file,
                                             const LoadOptions& options) {
  const fs::path run_file = states_file.parent_path() / "run.yaml";
  const auto run = description_in(run_file);
  const auto model = run ? model_file_of(*run) : std::nullopt;
  if (!model) return std::nullopt;
  LoadOptions as_then = options;
  if (options.mesh_scale == 1.0) as_then.mesh_scale = mesh_scale_of(*run);
  return load_model(*model, as_then);
}

KinematicTree tree_of_columns(const fs::path& states_file) {
  KinematicTree tree;
  tree.bodies.resize(1);
  for (const auto& name : joint_columns(states_file)) {
    const int index = static_cast<int>(tree.joints.size());
    Joint joint;
    joint.name = name;
    joint.type = JointType::continuous;
    joint.lower = -std::numeric_limits<double>::infinity();
    joint.upper = std::numeric_limits<double>::infinity();
    joint.child_body = index + 1;
    joint.variable = index;
    tree.joints.push_back(joint);
    Body body;
    body.name = name;
    body.links = {name};
    body.parent_joint = index;
    tree.bodies.push_back(std::move(body));
    tree.variable_joint.push_back(index);
    tree.file_order.push_back(index);
  }
  return tree;
}

}  // namespace lockbox::app
