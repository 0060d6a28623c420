// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

/// Reads the YAML file of a model; without the file all is default. Links must exist in the tree
/// and have geometry. Throws InputError with file and line. A file that holds none of a model's
/// keys, nor what looks like one misspelt, belongs to another program: it is passed over, with a
/// warning.
ModelParameters read_model_parameters(const std::filesystem::path& yaml, const KinematicTree& tree,
                                      const std::function<void(const std::string&)>& on_warning);

}  // namespace lockbox
