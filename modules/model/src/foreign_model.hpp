// SPDX-License-Identifier: BSD-3-Clause
// Files that are no models, given as one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace lockbox {

/// "is <what>, not a model; <what to do>", by the first bytes of the file or, where these tell
/// nothing, by its extension; nothing if it may be a URDF. Reads no more than the first bytes.
std::optional<std::string> foreign_model(const std::filesystem::path& file);

/// Says of an XML file whose first element is not <robot> what begins so, and what to do, or "".
std::string foreign_root(const std::string& element);

}  // namespace lockbox
