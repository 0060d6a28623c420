// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/joint_panel.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "letters.hpp"
#include "lockbox/core/units.hpp"

namespace lockbox {
namespace {

// What fits below each other in a window of 720 pixels.
constexpr std::size_t kMostLines = 32;
constexpr std::size_t kMostSliders = 14;

constexpr double kWithoutLimit = std::numbers::pi;  // to both sides: radians; metres for a slide

/// Its unit, and how many of it a radian or a metre is.
struct Unit {
  const char* name;
  double scale;
};

Unit unit_of(const Joint& joint) {
  return joint.type == JointType::prismatic ? Unit{"mm", kMillimetres} : Unit{"°", kDegrees};
}

/// Returns the joints that move by themselves, in the order of the file, as indices.
std::vector<int> moving_joints(const KinematicTree& tree) {
  std::vector<int> moving;
  for (const int j : tree.file_order) {
    if (!tree.joints[static_cast<std::size_t>(j)].is_mimic) moving.push_back(j);
  }
  return moving;
}

std::string one_decimal(double value) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << value;
  return text.str() == "-0.0" ? "0.0" : text.str();
}

std::string sigma_text(double sigma, const Unit& unit) {
  if (std::isnan(sigma)) return "";
  if (std::isinf(sigma)) return "unseen";
  if (sigma == 0.0) return "held";
  std::ostringstream text;
  text << "±" << std::setprecision(2) << sigma * unit.scale;
  return text.str();
}

std::string limits_text(const Joint& joint, const Unit& unit) {
  if (!std::isfinite(joint.lower) || !std::isfinite(joint.upper)) return "no limits";
  return one_decimal(unit.scale * joint.lower) + " to " + one_decimal(unit.scale * joint.upper);
}

/// Filled with blanks on the right.
std::string padded(const std::string& text, std::size_t width) {
  const std::size_t letters = count_letters(text);
  return text + std::string(width > letters ? width - letters : 0, ' ');
}

std::size_t longest_name(const KinematicTree& tree, const std::vector<int>& joints) {
  std::size_t length = 0;
  for (const int j : joints) {
    length = std::max(length, tree.joints[static_cast<std::size_t>(j)].name.size());
  }
  return length;
}

std::string line_of(const KinematicTree& tree, int j, const Configuration& configuration,
                    const std::vector<double>& sigma, std::size_t name_width) {
  constexpr int kValueWidth = 8;
  const auto index = static_cast<std::size_t>(j);
  const Joint& joint = tree.joints[index];
  const Unit unit = unit_of(joint);
  std::ostringstream line;
  line << padded(joint.name, name_width) << std::setw(kValueWidth)
       << one_decimal(unit.scale * joint_position(tree, configuration, j)) << ' '
       << padded(unit.name, 4);
  if (!sigma.empty()) line << padded(sigma_text(sigma[index], unit), 8);
  line << limits_text(joint, unit);
  return line.str();
}

}  // namespace

std::vector<JointLine> joint_lines(const KinematicTree& tree, const Configuration& configuration,
                                   const std::vector<double>& sigma) {
  const auto joints = moving_joints(tree);
  const std::size_t name_width = longest_name(tree, joints);
  std::vector<JointLine> lines;
  for (std::size_t i = 0; i < std::min(joints.size(), kMostLines); ++i) {
    lines.push_back({line_of(tree, joints[i], configuration, sigma, name_width),
                     static_cast<std::size_t>(joints[i])});
  }
  if (joints.size() > kMostLines) {
    lines.push_back({"and " + std::to_string(joints.size() - kMostLines) + " more", std::nullopt});
  }
  return lines;
}

std::string joint_panel(const KinematicTree& tree, const Configuration& configuration,
                        const std::vector<double>& sigma) {
  std::string lines;
  for (const JointLine& line : joint_lines(tree, configuration, sigma)) lines += '\n' + line.text;
  return lines;
}

std::size_t slider_pages(const KinematicTree& tree) {
  return (moving_joints(tree).size() + kMostSliders - 1) / kMostSliders;
}

std::string slider_page_text(const KinematicTree& tree, std::size_t page) {
  const std::size_t joints = moving_joints(tree).size();
  if (joints <= kMostSliders) return "";
  return "joints " + std::to_string(page * kMostSliders + 1) + " to " +
         std::to_string(std::min(joints, (page + 1) * kMostSliders)) + " of " +
         std::to_string(joints) + "; page keys: the others";
}

std::vector<SceneSlider> joint_sliders(const KinematicTree& tree,
                                       const Configuration& configuration, std::size_t page) {
  const auto joints = moving_joints(tree);
  const std::size_t end = std::min(joints.size(), (page + 1) * kMostSliders);
  std::vector<SceneSlider> sliders;
  for (std::size_t i = page * kMostSliders; i < end; ++i) {
    const Joint& joint = tree.joints[static_cast<std::size_t>(joints[i])];
    const Unit unit = unit_of(joint);
    const bool has_limits = std::isfinite(joint.lower) && std::isfinite(joint.upper);
    sliders.push_back({joint.name, std::string("%.1f ") + unit.name,
                       unit.scale * (has_limits ? joint.lower : -kWithoutLimit),
                       unit.scale * (has_limits ? joint.upper : kWithoutLimit),
                       unit.scale * joint_position(tree, configuration, joints[i]),
                       limits_text(joint, unit)});
  }
  return sliders;
}

void move_joint(const KinematicTree& tree, std::size_t page, const SliderMove& move,
                Configuration& configuration) {
  const auto joints = moving_joints(tree);
  if (!move.slider) return;
  const std::size_t at = page * kMostSliders + *move.slider;
  if (at >= joints.size()) return;
  const Joint& joint = tree.joints[static_cast<std::size_t>(joints[at])];
  configuration.q(joint.variable) = move.value / unit_of(joint).scale;
}

}  // namespace lockbox
