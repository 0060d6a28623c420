// SPDX-License-Identifier: BSD-3-Clause
// Tells the YAML file of a model from those of other programs, which like to have the same stem.
#pragma once

#include <string>

namespace lockbox {

/// The keys at the top of a model's YAML file.
inline const std::string kKeyList = "voxel, link_voxel, erosion, pair_erosion, initial_state";

/// Whether the text of a file, YAML or an attempt at it, has a key of a model at its top, or one
/// that seems to be misspelt. Empty files name nothing, and are as good as a model's.
bool names_model_keys(const std::string& file, const std::string& text);

}  // namespace lockbox
