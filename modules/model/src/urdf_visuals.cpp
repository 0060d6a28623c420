// SPDX-License-Identifier: BSD-3-Clause
#include "urdf_visuals.hpp"

#include <tinyxml2.h>

#include <cmath>

#include "urdf_origin.hpp"

namespace lockbox {
namespace {

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

void copy_visual(const XmlElement& visual, const MaterialTable& materials,
                 std::vector<std::string>& warnings, tinyxml2::XMLPrinter& out) {
  out.OpenElement("visual");
  copy_origin(visual, warnings, out);
  copy_geometry(visual.required_child("geometry"), out);
  if (const auto color = materials.color_of(visual, warnings)) {
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
