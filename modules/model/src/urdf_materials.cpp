// SPDX-License-Identifier: BSD-3-Clause
#include "urdf_materials.hpp"

#include <algorithm>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

/// Nothing without a <color> of four numbers from 0 to 1.
std::optional<Rgba> defined_color(const XmlElement& material) {
  const auto colors = material.children("color");
  if (colors.empty()) return std::nullopt;
  try {
    const auto rgba = colors.front().numbers("rgba", 4);
    if (!rgba || std::any_of(rgba->begin(), rgba->end(),
                             [](double share) { return share < 0.0 || share > 1.0; })) {
      return std::nullopt;
    }
    return Rgba{(*rgba)[0], (*rgba)[1], (*rgba)[2], (*rgba)[3]};
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool is_definition(const XmlElement& material) {
  return !material.children("color").empty() || !material.children("texture").empty();
}

void warn_once(const std::string& warning, std::vector<std::string>& warnings) {
  if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) {
    warnings.push_back(warning);
  }
}

}  // namespace

MaterialTable::MaterialTable(const XmlElement& robot) {
  for (const XmlElement& material : robot.children("material")) {
    top_level_.emplace(material.plain_attribute("name"), defined_color(material));
  }
  for (const XmlElement& link : robot.children("link")) {
    for (const XmlElement& visual : link.children("visual")) {
      for (const XmlElement& material : visual.children("material")) {
        if (!is_definition(material)) continue;
        in_links_.emplace(material.plain_attribute("name"), defined_color(material));
      }
    }
  }
}

std::optional<Rgba> MaterialTable::color_of(const XmlElement& visual,
                                            std::vector<std::string>& warnings) const {
  const auto materials = visual.children("material");
  if (materials.empty()) return std::nullopt;
  const XmlElement& material = materials.front();
  const std::string name = material.plain_attribute("name");
  if (!material.children("color").empty()) {
    const auto color = defined_color(material);
    if (!color) {
      warn_once(material.remark("its colour is not read (four numbers from 0 to 1): grey"),
                warnings);
    }
    return color;
  }
  if (is_definition(material)) return std::nullopt;
  for (const auto* const table : {&top_level_, &in_links_}) {
    if (const auto found = table->find(name); found != table->end()) return found->second;
  }
  warn_once(material.whole_file_remark("material " + in_quotes(name) +
                                       " is defined nowhere, and shown in grey"),
            warnings);
  return std::nullopt;
}

}  // namespace lockbox
