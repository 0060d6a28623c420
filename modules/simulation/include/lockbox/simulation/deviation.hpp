// SPDX-License-Identifier: BSD-3-Clause
// How a simulated object differs from its model, without a tracker being told. All that is drawn at
// random follows from the seed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lockbox {

/// What was built, against what was drawn.
struct ObjectDeviation {
  double scale = 1.0;          ///< of the whole object, about the origin of its base
  double sizes = 0.0;          ///< edge lengths of each part differ by up to this, metres
  double joint_origins = 0.0;  ///< how far each joint's origin is off, metres
  double joint_axes = 0.0;     ///< how far each joint's axis is tilted, radians
  int added_parts = 0;         ///< how many parts of 3 to 30 cm the model lacks, at least
  double added_share = 0.0;    ///< of the object's front that such parts cover, at least
  int missing_handles = 0;     ///< how many pieces that stand out of a part's front are missing
  std::vector<std::string> missing_parts =
      {};  ///< links that are missing, with all that they carry
};

struct Deviation {
  std::uint64_t seed = 1;
  ObjectDeviation object;
};

/// Reads a deviation file; its keys are the names of the members above (docs/file-formats.md).
/// Throws InputError with file, line and key.
Deviation read_deviation(const std::filesystem::path& file);

/// The text of a file that read_deviation() reads, all keys written out.
std::string deviation_text(const Deviation& deviation);

}  // namespace lockbox
