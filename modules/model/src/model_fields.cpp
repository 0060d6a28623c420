// SPDX-License-Identifier: BSD-3-Clause
#include "model_fields.hpp"

#include <algorithm>
#include <string>

#include "lockbox/core/error.hpp"
#include "lockbox/core/readable_text.hpp"
#include "lockbox/sdf/field_cache.hpp"

namespace lockbox {
namespace {

FieldOptions field_options(const Body& body, const ModelParameters& parameters) {
  FieldOptions options;
  if (parameters.voxel) options.voxel = *parameters.voxel;
  const auto own = parameters.link_voxel.find(body.name);
  if (own != parameters.link_voxel.end()) options.voxel = own->second;
  return options;
}

/// Which file to mend where the voxel was not chosen by the field itself.
std::string voxel_origin(const FieldOptions& options, const std::filesystem::path& model) {
  if (options.voxel == FieldOptions{}.voxel) return "";
  return "; the voxel is given in " +
         std::filesystem::path(model).replace_extension(".yaml").string();
}

/// left: bytes that the fields of the model may still take.
std::optional<SignedDistanceField> body_field(const Body& body, FieldOptions options, double left,
                                              const std::filesystem::path& cache,
                                              const std::filesystem::path& model, double most,
                                              const Executor& executor) {
  if (body.mesh.triangles.empty()) return std::nullopt;
  const bool is_scarce = left < options.memory_limit;
  if (is_scarce) {
    constexpr double kShare = 0.5;  // the coarse samples and the table take some, too
    options.memory_limit = left;
    options.memory_budget = std::min(options.memory_budget, kShare * left);
  }
  try {
    auto field = load_or_build_field(body.mesh, options, cache, executor);
    if (is_scarce && static_cast<double>(field.memory_bytes()) > left) {
      throw InputError("geometry", "its field takes more than what is left");
    }
    return field;
  } catch (const InputError& error) {
    throw InputError(model.string(),
                     "link '" + body.name + "': " + error.what() + voxel_origin(options, model) +
                         (is_scarce ? "; all fields of a model may take " +
                                          readable_number(1e-9 * most) + " GB together"
                                    : ""));
  }
}

}  // namespace

std::vector<std::optional<SignedDistanceField>> model_fields(const std::filesystem::path& file,
                                                             const std::vector<Body>& bodies,
                                                             const ModelParameters& parameters,
                                                             const std::filesystem::path& cache,
                                                             double most_bytes,
                                                             const Executor& executor) {
  std::vector<std::optional<SignedDistanceField>> fields;
  double left = most_bytes;
  for (const Body& body : bodies) {
    fields.push_back(
        body_field(body, field_options(body, parameters), left, cache, file, most_bytes, executor));
    if (!fields.back()) continue;
    left = std::max(0.0, left - static_cast<double>(fields.back()->memory_bytes()));
  }
  return fields;
}

}  // namespace lockbox
