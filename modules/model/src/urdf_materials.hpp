// SPDX-License-Identifier: BSD-3-Clause
// The colours of a robot. They are only shown, so that nothing about them stops a model.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "xml_element.hpp"

namespace lockbox {

using Rgba = std::array<double, 4>;

/// The named colours of a robot. A definition at the top level counts first, then the first one in
/// a link.
class MaterialTable {
 public:
  explicit MaterialTable(const XmlElement& robot);

  /// Colour of a visual; nothing where it has none, only a texture, or one that cannot be read or
  /// is defined nowhere: then a warning says so, once a material.
  std::optional<Rgba> color_of(const XmlElement& visual, std::vector<std::string>& warnings) const;

 private:
  std::map<std::string, std::optional<Rgba>> top_level_;
  std::map<std::string, std::optional<Rgba>> in_links_;
};

}  // namespace lockbox
