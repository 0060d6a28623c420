// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lockbox/core/error.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/cache_folder.hpp"
#include "lockbox/model/drawn_mesh.hpp"
#include "lockbox/model/symmetry.hpp"
#include "model_fields.hpp"
#include "model_parameters.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kFewTriangles = 2000;  // that take little time to draw
constexpr double kMostFieldBytes = 2e9;      // of a model: what small computers have to spare
constexpr double kMostVoxelsOff = 1.0;       // by which a drawing may differ from the field

void require_geometry(const ArticulatedModel& model) {
  const bool has_geometry = std::any_of(model.fields.begin(), model.fields.end(),
                                        [](const auto& field) { return field.has_value(); });
  if (!has_geometry) {
    throw InputError(model.file.string(), "no link has <visual> geometry: there is nothing to see");
  }
}

}  // namespace

ArticulatedModel load_model(const std::filesystem::path& file, const LoadOptions& options) {
  ArticulatedModel model;
  model.file = file;
  model.tree = load_kinematic_tree(file, options);
  model.parameters = read_model_parameters(std::filesystem::path(file).replace_extension(".yaml"),
                                           model.tree, options.on_warning);
  const auto cache = options.cache_directory.value_or(default_cache_folder());
  const Executor executor(0, Priority::normal, options.stop_request);
  model.fields =
      model_fields(file, model.tree.bodies, model.parameters, cache, kMostFieldBytes, executor);
  for (std::size_t b = 0; b < model.fields.size(); ++b) {
    if (!model.fields[b]) continue;
    Body& body = model.tree.bodies[b];
    const SignedDistanceField& field = *model.fields[b];
    body.mesh = drawn_mesh(body.mesh, field, kFewTriangles, kMostVoxelsOff * field.voxel());
  }
  require_geometry(model);
  model.round_axes = find_round_axes(model);
  return model;
}

}  // namespace lockbox
