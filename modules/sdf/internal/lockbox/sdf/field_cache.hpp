// SPDX-License-Identifier: BSD-3-Clause
// Fields on disk, named by what they were built from.
#pragma once

#include <filesystem>

#include "lockbox/sdf/build_field.hpp"

namespace lockbox {

/// The field of build_field(mesh, options, executor), read from the folder if it is there, else
/// built and left there.
///
/// The key is a hash of the mesh's coordinates (double, as passed: after scale and placement) and
/// triangles, of the options, and of the format: never of a name or a position in a model. A file
/// that is damaged, truncated or of another origin is built again and replaced. Processes and
/// threads may share the folder: files appear under their name only when complete. A folder that
/// cannot be made, read or written is as good as none; an empty path means none.
/// Throws what build_field throws.
SignedDistanceField load_or_build_field(const TriangleMesh& mesh, const FieldOptions& options,
                                        const std::filesystem::path& folder,
                                        const Executor& executor);

}  // namespace lockbox
