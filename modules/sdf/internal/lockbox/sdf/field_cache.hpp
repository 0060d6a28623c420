// SPDX-License-Identifier: BSD-3-Clause
// Fields on disk, named by what they were built from.
#pragma once

#include <cstddef>
#include <cstdint>
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

/// What the fields of a folder take.
struct CachedFields {
  std::size_t files = 0;
  std::uintmax_t bytes = 0;
};

/// More than this is not kept: what was not used for the longest time goes when a field is added.
/// Fields of about a hundred models. Doubled, twice as many models load at once.
inline constexpr std::uintmax_t kMostCachedBytes = std::uintmax_t{1} << 30;

CachedFields cached_fields(const std::filesystem::path& folder);

/// Deletes those that were not used for the longest time, until the others take no more than that.
/// Returns what is left. Other files in the folder are left alone, and so is what cannot be
/// deleted.
CachedFields limit_fields(const std::filesystem::path& folder, std::uintmax_t most_bytes);

}  // namespace lockbox
