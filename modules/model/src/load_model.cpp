// SPDX-License-Identifier: BSD-3-Clause
#include "cache_folder.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/sdf/field_cache.hpp"
#include "model_parameters.hpp"

namespace lockbox {
namespace {

FieldOptions field_options(const Body& body, const ModelParameters& parameters) {
  FieldOptions options;
  if (parameters.voxel) options.voxel = *parameters.voxel;
  const auto own = parameters.link_voxel.find(body.name);
  if (own != parameters.link_voxel.end()) options.voxel = own->second;
  return options;
}

std::optional<SignedDistanceField> body_field(const Body& body, const FieldOptions& options,
                                              const std::filesystem::path& cache,
                                              const std::filesystem::path& model,
                                              const Executor& executor) {
  if (body.mesh.triangles.empty()) return std::nullopt;
  try {
    return load_or_build_field(body.mesh, options, cache, executor);
  } catch (const InputError& error) {
    throw InputError(model.string(), "link '" + body.name + "': " + error.what());
  }
}

}  // namespace

ArticulatedModel load_model(const std::filesystem::path& file, const LoadOptions& options) {
  ArticulatedModel model;
  model.file = file;
  model.tree = load_kinematic_tree(file, options);
  model.parameters =
      read_model_parameters(std::filesystem::path(file).replace_extension(".yaml"), model.tree);
  const auto cache = options.cache_directory.value_or(default_cache_folder());
  const Executor executor;
  for (const Body& body : model.tree.bodies) {
    model.fields.push_back(
        body_field(body, field_options(body, model.parameters), cache, file, executor));
  }
  return model;
}

}  // namespace lockbox
