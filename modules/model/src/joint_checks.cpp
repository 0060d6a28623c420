// SPDX-License-Identifier: BSD-3-Clause
#include "joint_checks.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "length_units.hpp"
#include "lockbox/core/readable_text.hpp"
#include "lockbox/core/units.hpp"

namespace lockbox {
namespace {

constexpr double kNoMotion = 1e-5;  // radians or metres; far less than any camera shows

double farthest(const Joint& joint) {
  return std::max(std::abs(joint.lower), std::abs(joint.upper));
}

std::string range_text(double lower, double upper, double factor = 1.0) {
  constexpr int kDigits = 4;
  return readable_number(factor * lower, kDigits) + " to " +
         readable_number(factor * upper, kDigits);
}

bool is_whole(double value) {
  return value == std::round(value);
}

/// Beyond two turns; or beyond one in whole numbers, which radians hardly ever are.
bool looks_like_degrees(const Joint& joint) {
  constexpr double kRounding = 1.01;
  const double turns = farthest(joint) / kFullTurn;
  return turns > 2.0 * kRounding ||
         (turns > kRounding && is_whole(joint.lower) && is_whole(joint.upper));
}

void check_angles(const Joint& joint, const JointRemark& warn) {
  constexpr double kMostDegrees = 3600.0;  // ten turns
  if (!looks_like_degrees(joint)) return;
  const std::string range = range_text(joint.lower, joint.upper);
  const std::string endless = "if it turns without an end, it is of the type continuous";
  if (farthest(joint) > kMostDegrees) {
    warn(joint.name, "its limits, " + range + ", are in radians; " + endless);
    return;
  }
  warn(joint.name, "its limits, " + range + ", are in radians (" +
                       range_text(joint.lower, joint.upper, kDegrees) +
                       " degrees): if degrees are meant, write " +
                       range_text(joint.lower, joint.upper, kRadians) + "; " + endless);
}

void check_travel(const Joint& joint, double largest_link, const JointRemark& warn) {
  constexpr double kAnyTravel = 2.0;  // metres; rails are as long as that
  constexpr double kMillimetre = 0.001;
  const double travel = farthest(joint);
  const double most =
      largest_link > 0.0 ? std::max(kAnyTravel, kOutOfProportion * largest_link) : kLargestSeen;
  if (travel <= std::min(most, kLargestSeen)) return;
  const std::string text = "its limits, " + range_text(joint.lower, joint.upper) +
                           ", are in metres, and farther apart than the object is large";
  if (!is_size_of_things(kMillimetre * travel) && kMillimetre * travel > kSmallestSeen) {
    warn(joint.name, text + ": give the range in which it can move");
    return;
  }
  warn(joint.name, text + ": if millimetres are meant, write " +
                       range_text(joint.lower, joint.upper, kMillimetre) +
                       ", as --mesh-scale converts meshes alone");
}

/// The limits of a mimic that the joint it mimics leads to.
std::pair<double, double> followed_limits(const Joint& mimic, const Joint& driver) {
  if (mimic.multiplier == 0.0) return {mimic.offset, mimic.offset};
  const double a = mimic.multiplier * driver.lower + mimic.offset;
  const double b = mimic.multiplier * driver.upper + mimic.offset;
  return std::minmax(a, b);
}

}  // namespace

void check_limits(const KinematicTree& tree, double largest_link, const JointRemark& warn) {
  for (const Joint& joint : tree.joints) {
    if (joint.upper - joint.lower <= kNoMotion) {
      warn(joint.name, joint.is_mimic
                           ? "it cannot move, as what it mimics, times its multiplier, does not"
                           : "it cannot move: its limits are " +
                                 range_text(joint.lower, joint.upper) +
                                 "; widen them, or make it fixed (or continuous)");
    }
    if (joint.is_mimic || joint.type == JointType::continuous) continue;
    if (joint.type == JointType::prismatic) {
      check_travel(joint, largest_link, warn);
    } else {
      check_angles(joint, warn);
    }
  }
}

void set_mimic_limits(const std::map<std::string, std::pair<double, double>>& in_file,
                      KinematicTree& tree, const JointRemark& warn) {
  constexpr double kRounding = 0.05;  // of a range: limits are written with a few digits
  for (Joint& joint : tree.joints) {
    if (!joint.is_mimic) continue;
    const auto& driver = tree.joints[static_cast<std::size_t>(
        tree.variable_joint[static_cast<std::size_t>(joint.variable)])];
    std::tie(joint.lower, joint.upper) = followed_limits(joint, driver);
    const auto own = in_file.find(joint.name);
    if (own == in_file.end() || joint.type == JointType::continuous) continue;
    const auto [lower, upper] = own->second;
    const double allowed =
        std::max(kRounding * std::min(joint.upper - joint.lower, kFullTurn), kNoMotion);
    if (lower <= joint.lower + allowed && upper >= joint.upper - allowed) continue;
    warn(joint.name, "it mimics '" + driver.name + "', and moves with it from " +
                         range_text(joint.lower, joint.upper) + "; its own limits, " +
                         range_text(lower, upper) + ", are not enforced");
  }
}

}  // namespace lockbox
