// SPDX-License-Identifier: BSD-3-Clause
// The distance fields of all bodies, within one limit of memory.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

/// One field for each body, none for those without geometry. Where they would take more bytes than
/// that, later ones get coarser voxels, as far as the model's parameters let them be chosen.
/// cache: see load_or_build_field(). Throws InputError that names file and link where a field
/// cannot be built, or not within what the others have left.
std::vector<std::optional<SignedDistanceField>> model_fields(const std::filesystem::path& file,
                                                             const std::vector<Body>& bodies,
                                                             const ModelParameters& parameters,
                                                             const std::filesystem::path& cache,
                                                             double most_bytes,
                                                             const Executor& executor);

}  // namespace lockbox
