// SPDX-License-Identifier: BSD-3-Clause
#include "size_advice.hpp"

#include <cmath>

#include "length_units.hpp"
#include "lockbox/core/readable_text.hpp"

namespace lockbox {
namespace {

bool is_mesh(const VisualExtent& visual) {
  return visual.shape == "mesh";
}

std::string subject(const VisualExtent& visual, const SizeContext& context) {
  if (context.is_bare) return "the mesh";
  return is_mesh(visual) ? "its mesh " + visual.file : "its <" + visual.shape + ">";
}

std::string size_text(const VisualExtent& visual, const SizeContext& context,
                      const std::string& beyond) {
  return subject(visual, context) + " is " + readable_length(visual.size()) + " large, " + beyond;
}

std::string factor_text(double factor) {
  constexpr int kDigits = 6;
  return readable_number(factor, kDigits);
}

/// The attribute with all three numbers times the factor.
std::string scale_text(const VisualExtent& visual, double factor) {
  const Eigen::Vector3d scale = factor * visual.scale;
  return "scale=\"" + factor_text(scale.x()) + " " + factor_text(scale.y()) + " " +
         factor_text(scale.z()) + "\"";
}

/// What makes a mesh so many times as large.
std::string remedy(const VisualExtent& visual, const SizeContext& context, double factor) {
  const std::string option = "--mesh-scale " + factor_text(context.mesh_scale * factor);
  if (context.is_bare) return "give " + option;
  if (context.mesh_scale != 1.0) return "give " + option + " instead, which holds for all meshes";
  return "write " + scale_text(visual, factor) + " in its <mesh>, or give " + option +
         " for all meshes";
}

/// What the model gave, without which the mesh would be of another size.
std::string scale_in_force(const VisualExtent& visual, const SizeContext& context) {
  if (context.mesh_scale != 1.0) return "--mesh-scale " + factor_text(context.mesh_scale);
  return scale_text(visual, 1.0);
}

std::string meant(const LengthUnit& unit, const std::string& what, double number) {
  return what + " seems to be in " + unit.name + " (then it is " +
         readable_length(unit.metres * number) + " large)";
}

/// The unit that the number may be in as well, with what to write then; empty if it is told apart.
std::string or_meant(const VisualExtent& visual, const SizeContext& context, double number,
                     double per_metre) {
  const auto other = other_unit(number, context.usual);
  if (!other) return "";
  const double factor = other->metres / per_metre;
  return std::string("; or it is in ") + other->name + " (then it is " +
         readable_length(other->metres * number) + " large): " +
         (context.is_bare || context.mesh_scale != 1.0
              ? "--mesh-scale " + factor_text(context.mesh_scale * factor)
              : scale_text(visual, factor));
}

/// Returns by how much the numbers of the file were multiplied.
double total_scale(const VisualExtent& visual, const SizeContext& context) {
  return std::cbrt(visual.scale.cwiseAbs().prod()) * context.mesh_scale;
}

/// Where the numbers of the file are metres, so that scaling them was wrong.
std::string advice_without_scale(const VisualExtent& visual, const SizeContext& context) {
  const double in_file = visual.size() / total_scale(visual, context);
  return "; its file seems to be in metres already (then it is " + readable_length(in_file) +
         " large): leave out " + scale_in_force(visual, context);
}

}  // namespace

std::string advice_on_large(const VisualExtent& visual, const SizeContext& context) {
  const std::string size = size_text(visual, context, "more than a depth camera sees");
  constexpr double kClearlyScaled = 2.0;
  const double scale = total_scale(visual, context);
  if (is_mesh(visual) && scale > kClearlyScaled && is_size_of_things(visual.size() / scale)) {
    return size + advice_without_scale(visual, context);
  }
  const auto unit = probable_unit(visual.size(), context.usual);
  if (!unit) return size + "; lengths are in metres";
  if (!is_mesh(visual)) {
    return size + "; it seems to be given in " + unit->name + ": write it in metres, " +
           factor_text(unit->metres) + " times as large";
  }
  return size + "; " + meant(*unit, "it", visual.size()) + ": " +
         remedy(visual, context, unit->metres) + or_meant(visual, context, visual.size(), 1.0) +
         (context.is_bare ? "" : "; origins and limits of joints are not converted with it");
}

std::string advice_on_small(const VisualExtent& visual, const SizeContext& context) {
  constexpr double kClearlyScaled = 0.5;
  constexpr double kTwice = 1000.0;  // by which a mesh is too small that was converted twice
  const std::string size = size_text(visual, context, "less than a depth camera can tell");
  if (!is_mesh(visual)) return size + "; lengths are in metres";
  const double scale = total_scale(visual, context);
  const double in_file = visual.size() / scale;
  if (scale < kClearlyScaled && is_size_of_things(in_file)) {
    return size + advice_without_scale(visual, context);
  }
  if (const auto unit = probable_unit(in_file, context.usual); unit && scale < kClearlyScaled) {
    return size + "; " + meant(*unit, "its file", in_file) + ": " +
           remedy(visual, context, unit->metres / scale) +
           or_meant(visual, context, in_file, scale);
  }
  if (!is_size_of_things(kTwice * visual.size())) return size + "; lengths are in metres";
  return size + "; lengths are in metres: if it was converted from millimetres twice, " +
         remedy(visual, context, kTwice);
}

}  // namespace lockbox
