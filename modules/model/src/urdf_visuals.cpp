// SPDX-License-Identifier: BSD-3-Clause
#include "urdf_visuals.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>

#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

// Far beyond every depth camera, and small enough that products of many stay finite.
constexpr double kLargestLength = 1e6;  // metres

std::vector<double> lengths(const XmlElement& element, const std::string& name, std::size_t count) {
  const auto values = element.numbers(name, count);
  if (!values) element.refuse("<" + element.name() + "> needs the attribute '" + name + "'");
  for (const double value : *values) {
    if (!(value > 0.0 && value <= kLargestLength)) {
      element.refuse("'" + name + "' of <" + element.name() + "> must be positive, in metres");
    }
  }
  return *values;
}

std::optional<Rgba> defined_color(const XmlElement& material) {
  const auto color = material.child("color");
  if (!color) return std::nullopt;
  const auto values = color->numbers("rgba", 4);
  if (!values) color->refuse("<color> needs the attribute 'rgba'");
  if (std::any_of(values->begin(), values->end(), [](double v) { return v < 0.0 || v > 1.0; })) {
    color->refuse("the numbers of 'rgba' must lie between 0 and 1");
  }
  return Rgba{(*values)[0], (*values)[1], (*values)[2], (*values)[3]};
}

void copy_mesh(const XmlElement& mesh, tinyxml2::XMLPrinter& out) {
  out.PushAttribute("filename", mesh.required_attribute("filename").c_str());
  const auto scale = mesh.numbers("scale", 3);
  if (!scale) return;
  for (const double factor : *scale) {
    if (factor == 0.0 || std::abs(factor) > kLargestLength) {
      mesh.refuse("'scale' of <mesh> must not be 0 (nor beyond a million)");
    }
  }
  write_numbers(out, "scale", *scale);
}

void copy_geometry(const XmlElement& geometry, tinyxml2::XMLPrinter& out) {
  const auto shapes = geometry.children();
  if (shapes.size() != 1) geometry.refuse("<geometry> needs exactly one shape");
  const XmlElement& shape = shapes.front();
  out.OpenElement("geometry");
  out.OpenElement(shape.name().c_str());
  if (shape.name() == "mesh") {
    copy_mesh(shape, out);
  } else if (shape.name() == "box") {
    write_numbers(out, "size", lengths(shape, "size", 3));
  } else if (shape.name() == "cylinder") {
    write_numbers(out, "radius", lengths(shape, "radius", 1));
    write_numbers(out, "length", lengths(shape, "length", 1));
  } else if (shape.name() == "sphere") {
    write_numbers(out, "radius", lengths(shape, "radius", 1));
  } else {
    shape.refuse("shape <" + shape.name() + "> is unknown; use mesh, box, cylinder or sphere");
  }
  out.CloseElement();
  out.CloseElement();
}

}  // namespace

MaterialTable::MaterialTable(const XmlElement& robot) {
  for (const XmlElement& material : robot.children("material")) {
    const std::string name = material.required_attribute("name");
    const auto color = defined_color(material);
    const auto [first, is_new] = top_level_.emplace(name, Definition{color, false});
    if (!is_new && first->second.color != color) {
      material.refuse("material '" + name + "' is defined twice, with different colours");
    }
  }
  for (const XmlElement& link : robot.children("link")) {
    for (const XmlElement& visual : link.children("visual")) {
      if (const auto material = visual.child("material")) define(*material);
    }
  }
}

void MaterialTable::define(const XmlElement& material) {
  const bool defines = material.child("color") || material.child("texture");
  if (!defines) return;
  const auto color = defined_color(material);
  const auto [first, is_new] =
      in_links_.emplace(material.attribute("name").value_or(""), Definition{color, false});
  if (!is_new && first->second.color != color) first->second.ambiguous = true;
}

std::optional<Rgba> MaterialTable::color_of(const XmlElement& visual) const {
  const auto material = visual.child("material");
  if (!material) return std::nullopt;
  if (material->child("color") || material->child("texture")) return defined_color(*material);
  const std::string name = material->required_attribute("name");
  if (const auto found = top_level_.find(name); found != top_level_.end()) {
    return found->second.color;
  }
  const auto found = in_links_.find(name);
  if (found == in_links_.end()) {
    material->refuse("material '" + name + "' is defined nowhere; give it a <color>");
  }
  if (found->second.ambiguous) {
    material->refuse("links define material '" + name +
                     "' with different colours; define it once, directly below <robot>");
  }
  return found->second.color;
}

void write_numbers(tinyxml2::XMLPrinter& out, const char* name, const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text.append(text.empty() ? "" : " ").append(number_text(value));
  out.PushAttribute(name, text.c_str());
}

void copy_origin(const XmlElement& parent, tinyxml2::XMLPrinter& out) {
  const auto origin = parent.child("origin");
  if (!origin) return;
  if (origin->attribute("quat_xyzw")) {
    origin->refuse("<origin> with 'quat_xyzw' is not supported; write the rotation as 'rpy'");
  }
  out.OpenElement("origin");
  if (const auto xyz = origin->numbers("xyz", 3)) {
    for (const double value : *xyz) {
      if (std::abs(value) > kLargestLength) origin->refuse("'xyz' is beyond a million metres");
    }
    write_numbers(out, "xyz", *xyz);
  }
  if (const auto rpy = origin->numbers("rpy", 3)) write_numbers(out, "rpy", *rpy);
  out.CloseElement();
}

void copy_visual(const XmlElement& visual, const MaterialTable& materials,
                 tinyxml2::XMLPrinter& out) {
  out.OpenElement("visual");
  copy_origin(visual, out);
  copy_geometry(visual.required_child("geometry"), out);
  if (const auto color = materials.color_of(visual)) {
    out.OpenElement("material");
    out.PushAttribute("name", "");  // urdfdom looks up the others, last definition first
    out.OpenElement("color");
    write_numbers(out, "rgba", {color->begin(), color->end()});
    out.CloseElement();
    out.CloseElement();
  }
  out.CloseElement();
}

}  // namespace lockbox
