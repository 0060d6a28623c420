// SPDX-License-Identifier: BSD-3-Clause
// Copies <origin> elements to a new document, as far as they are sound.
#pragma once

#include <string>
#include <vector>

#include "xml_element.hpp"

namespace tinyxml2 {
class XMLPrinter;
}

namespace lockbox {

/// Metres. Far beyond every depth camera, and small enough that products of many stay finite.
inline constexpr double kLargestLength = 1e6;

/// Writes "a b c" with round-trip precision.
void write_numbers(tinyxml2::XMLPrinter& out, const char* name, const std::vector<double>& values);

/// Copies the <origin> of parent, if it has one. Angles that look like degrees are warned of.
void copy_origin(const XmlElement& parent, std::vector<std::string>& warnings,
                 tinyxml2::XMLPrinter& out);

}  // namespace lockbox
