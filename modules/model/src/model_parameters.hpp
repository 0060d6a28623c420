// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

/// Reads the YAML file of a model; without the file all is default. Links must exist in the tree
/// and have geometry. Throws InputError with file and line.
ModelParameters read_model_parameters(const std::filesystem::path& yaml, const KinematicTree& tree);

}  // namespace lockbox
