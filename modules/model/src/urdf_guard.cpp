// SPDX-License-Identifier: BSD-3-Clause
#include "urdf_guard.hpp"

#include <tinyxml2.h>

#include <cmath>

#include "foreign_model.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "states_columns.hpp"
#include "urdf_origin.hpp"
#include "urdf_topology.hpp"
#include "urdf_visuals.hpp"
#include "xml_element.hpp"

namespace lockbox {
namespace {

/// Refuses joint names that no column of a states file could bear.
void check_column_name(const XmlElement& joint, const std::string& name) {
  if (is_reserved_column(name)) {
    joint.refuse("the name belongs to another column of states files; rename the joint");
  }
  if (name.find_first_of(",\"'") != std::string::npos || name.front() == ' ' ||
      name.back() == ' ') {
    joint.refuse(
        "the name would break the header of a states file; rename the joint, without "
        "commas, quotes, and blanks at its ends");
  }
}

void copy_axis(const XmlElement& joint, tinyxml2::XMLPrinter& out) {
  const auto axis = joint.child("axis");
  if (!axis) return;
  const auto xyz = axis->numbers("xyz", 3);
  if (!xyz) axis->refuse("<axis> needs the attribute 'xyz'");
  const double length = std::hypot((*xyz)[0], (*xyz)[1], (*xyz)[2]);
  if (!(length > 1e-9 && length < 1e9)) {
    axis->refuse("the axis must be a direction like \"0 0 1\"; its length is 0 or absurd");
  }
  out.OpenElement("axis");
  write_numbers(out, "xyz", *xyz);
  out.CloseElement();
}

void write_limit(double lower, double upper, tinyxml2::XMLPrinter& out) {
  out.OpenElement("limit");
  write_numbers(out, "lower", {lower});
  write_numbers(out, "upper", {upper});
  write_numbers(out, "effort", {0.0});  // wanted by urdfdom, used by nobody
  write_numbers(out, "velocity", {0.0});
  out.CloseElement();
}

void copy_limit(const XmlElement& joint, tinyxml2::XMLPrinter& out) {
  const auto limit = joint.child("limit");
  const auto lower = limit ? limit->number("lower") : std::nullopt;
  const auto upper = limit ? limit->number("upper") : std::nullopt;
  if (!lower && !upper) {
    joint.refuse(
        "needs <limit lower=\"...\" upper=\"...\"/> (radians or metres), or the type "
        "continuous");
  }
  if (lower.value_or(0.0) > upper.value_or(0.0)) {
    limit->refuse("the lower limit is above the upper one (a missing one counts as 0); swap them");
  }
  write_limit(lower.value_or(0.0), upper.value_or(0.0), out);
}

void copy_mimic(const XmlElement& mimic, tinyxml2::XMLPrinter& out) {
  out.OpenElement("mimic");
  out.PushAttribute("joint", mimic.required_attribute("joint").c_str());
  write_numbers(out, "multiplier", {mimic.number("multiplier").value_or(1.0)});
  write_numbers(out, "offset", {mimic.number("offset").value_or(0.0)});
  out.CloseElement();
}

void check_type(const XmlElement& joint, const std::string& type) {
  if (type == "fixed" || type == "revolute" || type == "continuous" || type == "prismatic") return;
  joint.refuse("type '" + type +
               "' is not supported; use revolute, continuous, prismatic or fixed" +
               (type == "planar" || type == "floating" ? " (or a chain of them)" : ""));
}

void write_link_reference(tinyxml2::XMLPrinter& out, const char* tag, const std::string& link) {
  out.OpenElement(tag);
  out.PushAttribute("link", link.c_str());
  out.CloseElement();
}

/// Limits of a mimic joint are often copied from another one, or missing: they are read as far as
/// they can be, and nothing about them is a reason to refuse it.
void keep_mimic_limit(const XmlElement& joint, const std::string& name, GuardedUrdf& guarded) {
  const auto limits = joint.children("limit");
  if (limits.empty()) return;
  const auto bound = [&](const char* attribute) {
    return parse_finite_number(limits.front().plain_attribute(attribute)).value_or(0.0);
  };
  guarded.mimic_limits.emplace(name, std::pair{bound("lower"), bound("upper")});
}

UrdfJoint copy_joint(const XmlElement& element, GuardedUrdf& guarded, tinyxml2::XMLPrinter& out) {
  UrdfJoint result;
  result.name = element.required_attribute("name");
  result.line = element.line();
  const XmlElement joint = element.about("joint '" + result.name + "'");
  result.type = joint.required_attribute("type");
  check_type(joint, result.type);
  result.parent = joint.required_child("parent").required_attribute("link");
  result.child = joint.required_child("child").required_attribute("link");

  out.OpenElement("joint");
  out.PushAttribute("name", result.name.c_str());
  out.PushAttribute("type", result.type.c_str());
  write_link_reference(out, "parent", result.parent);
  write_link_reference(out, "child", result.child);
  copy_origin(joint, guarded.warnings, out);
  if (result.type != "fixed") {
    check_column_name(joint, result.name);
    copy_axis(joint, out);
    if (const auto mimic = joint.child("mimic")) {
      result.mimics = mimic->required_attribute("joint");
      copy_mimic(*mimic, out);
      keep_mimic_limit(joint, result.name, guarded);
      write_limit(0.0, 0.0, out);
    } else if (result.type != "continuous") {
      copy_limit(joint, out);
    }
  }
  out.CloseElement();
  return result;
}

UrdfLink copy_link(const XmlElement& element, const MaterialTable& materials,
                   std::vector<std::string>& warnings, tinyxml2::XMLPrinter& out) {
  const std::string name = element.required_attribute("name");
  const XmlElement link = element.about("link '" + name + "'");
  out.OpenElement("link");
  out.PushAttribute("name", name.c_str());
  for (const XmlElement& visual : link.children("visual")) {
    copy_visual(visual, materials, warnings, out);
  }
  out.CloseElement();
  return {name, element.line()};
}

void refuse_xacro(const XmlElement& robot) {
  for (const XmlElement& element : robot.children()) {
    if (element.name().rfind("xacro:", 0) == 0) {
      element.refuse("<" + element.name() +
                     "> is a xacro macro; expand the file first: xacro in.xacro > out.urdf");
    }
  }
}

XmlElement parsed_robot(const std::string& file, const std::string& text,
                        tinyxml2::XMLDocument& document) {
  if (text.find('\0') != std::string::npos) throw InputError(file, "holds a zero byte: not a URDF");
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(
        file, document.ErrorLineNum(),
        "not well-formed XML (" + std::string(document.ErrorName()) + "); is the file complete?");
  }
  const tinyxml2::XMLElement* root = document.RootElement();
  if (root == nullptr) throw InputError(file, "holds no XML element; a URDF begins with <robot>");
  const XmlElement robot{file, *root, "robot"};
  if (robot.name() != "robot") {
    robot.refuse("a URDF begins with <robot>, not with <" + robot.name() + ">" +
                 foreign_root(robot.name()));
  }
  return robot;
}

}  // namespace

GuardedUrdf guard_urdf(const std::string& file, const std::string& text) {
  tinyxml2::XMLDocument document;
  const XmlElement robot = parsed_robot(file, text, document);
  refuse_xacro(robot);

  tinyxml2::XMLPrinter out{nullptr, true};
  out.OpenElement("robot");
  out.PushAttribute("name", robot.required_attribute("name").c_str());
  GuardedUrdf guarded;
  std::vector<UrdfLink> links;
  const MaterialTable materials{robot};
  for (const XmlElement& element : robot.children("link")) {
    links.push_back(copy_link(element, materials, guarded.warnings, out));
    guarded.link_lines.emplace(links.back().name, links.back().line);
    if (element.children("visual").empty() && !element.children("collision").empty()) {
      guarded.collision_only_links.push_back(links.back().name);
    }
  }
  std::vector<UrdfJoint> joints;
  for (const XmlElement& element : robot.children("joint")) {
    joints.push_back(copy_joint(element, guarded, out));
    guarded.joint_lines.emplace(joints.back().name, joints.back().line);
    if (joints.back().type != "fixed") guarded.movable_joints.push_back(joints.back().name);
  }
  out.CloseElement();
  check_topology(file, links, joints);
  guarded.text = out.CStr();
  return guarded;
}

}  // namespace lockbox
