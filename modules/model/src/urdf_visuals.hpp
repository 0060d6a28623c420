// SPDX-License-Identifier: BSD-3-Clause
// Copies <visual> elements to a new document, as far as they are sound.
#pragma once

#include <string>
#include <vector>

#include "urdf_materials.hpp"
#include "xml_element.hpp"

namespace tinyxml2 {
class XMLPrinter;
}

namespace lockbox {

/// Appends what is strange, but no reason to refuse it, to the warnings.
void copy_visual(const XmlElement& visual, const MaterialTable& materials,
                 std::vector<std::string>& warnings, tinyxml2::XMLPrinter& out);

}  // namespace lockbox
