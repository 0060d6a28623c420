// SPDX-License-Identifier: BSD-3-Clause
// Copies <origin> and <visual> elements to a new document, as far as they are sound.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "xml_element.hpp"

namespace tinyxml2 {
class XMLPrinter;
}

namespace lockbox {

using Rgba = std::array<double, 4>;

/// The named colours of a robot. A definition at the top level counts first.
class MaterialTable {
 public:
  explicit MaterialTable(const XmlElement& robot);

  /// Colour of a visual; nothing where it has none (or only a texture).
  std::optional<Rgba> color_of(const XmlElement& visual) const;

 private:
  struct Definition {
    std::optional<Rgba> color;
    bool ambiguous = false;  ///< links define the name differently
  };
  void define(const XmlElement& material);

  std::map<std::string, Definition> top_level_;
  std::map<std::string, Definition> in_links_;
};

/// Writes "a b c" with round-trip precision.
void write_numbers(tinyxml2::XMLPrinter& out, const char* name, const std::vector<double>& values);

/// Copies the <origin> of parent, if it has one.
void copy_origin(const XmlElement& parent, tinyxml2::XMLPrinter& out);

void copy_visual(const XmlElement& visual, const MaterialTable& materials,
                 tinyxml2::XMLPrinter& out);

}  // namespace lockbox
