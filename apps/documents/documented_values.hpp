// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lockbox::app {

/// A member of an aggregate of options, or a named constant, as its header has it.
struct DocumentedValue {
  std::string name;
  std::string standard;  ///< the value unless told otherwise
  std::string unit;      ///< `Unit: metres.` of its comment; empty if it has none
  std::string source;    ///< `Source: measured.` of its comment, or of that of the aggregate
  std::string effect;    ///< what else its comment says
};

/// All values of a header that have a documenting comment above them. Throws InputError, with file
/// and line, for a value without one, and if the header cannot be read.
std::vector<DocumentedValue> read_documented_values(const std::filesystem::path& header);

}  // namespace lockbox::app
