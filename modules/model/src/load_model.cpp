// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lockbox/core/error.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/mesh/simplify.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/cache_folder.hpp"
#include "lockbox/model/symmetry.hpp"
#include "model_fields.hpp"
#include "model_parameters.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kFewTriangles = 2000;  // that take little time to draw
constexpr double kMostFieldBytes = 2e9;      // of a model: what small computers have to spare
constexpr double kMostVoxelsOff = 1.0;       // by which a drawing may differ from the field

/// By corners and middles of triangles: where a small part is missing, they lie within the body.
bool lies_on(const SignedDistanceField& field, const TriangleMesh& mesh) {
  const double most = kMostVoxelsOff * field.voxel();
  const auto is_near = [&](const Eigen::Vector3d& p) {
    return std::abs(static_cast<double>(field.sample(p.cast<float>()).distance)) <= most;
  };
  const auto middle_is_near = [&](const auto& triangle) {
    const auto& [a, b, c] = triangle;
    return is_near((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0);
  };
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), is_near) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), middle_is_near);
}

/// Of many triangles most are smaller than a pixel: as few as show the same surface.
TriangleMesh drawn_mesh(const TriangleMesh& mesh, const SignedDistanceField& field) {
  for (std::size_t few = kFewTriangles; 2 * few <= mesh.triangles.size(); few *= 2) {
    TriangleMesh simple = simplified(mesh, few);
    if (lies_on(field, simple)) return simple;
  }
  return mesh;
}

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
    body.mesh = drawn_mesh(body.mesh, *model.fields[b]);
  }
  require_geometry(model);
  model.round_axes = find_round_axes(model);
  return model;
}

}  // namespace lockbox
