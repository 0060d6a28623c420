// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "lockbox/model/articulated_model.hpp"

namespace lockbox::app {

/// The model that the run.yaml beside the states file names; nothing if there is none, or the model
/// is gone. Throws InputError.
std::optional<ArticulatedModel> model_of_run(const std::filesystem::path& states_file,
                                             const LoadOptions& options);

/// A tree of joints of unknown type, one for each column between the pose and the status, which are
/// compared modulo 2 pi. Throws InputError.
KinematicTree tree_of_columns(const std::filesystem::path& states_file);

}  // namespace lockbox::app
