// SPDX-License-Identifier: BSD-3-Clause
#include "plausible_states.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/core/error.hpp"
#include "lockbox/core/readable_text.hpp"
#include "lockbox/core/units.hpp"

namespace lockbox::app {
namespace {

/// Share of its range by which a joint of a real object may be beyond the limits of its model, or
/// radians or metres where the range is narrow. Doubled, a drawer of 5 mm passes in millimetres.
constexpr double kBeyond = 0.5;
constexpr double kBeyondNarrow = 0.1;

std::string problem_of_base(const Configuration& configuration) {
  const double distance = configuration.T_camera_base.translation().norm();
  if (distance <= kFarthestBase) return "";
  const bool may_be_millimetres = distance / kMillimetres <= kFarthestBase;
  return "puts the base " + readable_length(distance) +
         " away from the camera, where no depth camera sees it; positions are in metres" +
         (may_be_millimetres ? ", these seem to be in millimetres: divide them by 1000" : "");
}

std::string advice(bool slides, bool may_be_other_unit) {
  if (slides) {
    return may_be_other_unit
               ? "positions are in metres, these seem to be in millimetres: divide them by 1000"
               : "positions are in metres";
  }
  return may_be_other_unit
             ? "positions are in radians, these seem to be in degrees: multiply them by 0.0174533"
             : "positions are in radians";
}

std::string problem_of_joint(const KinematicTree& tree, int variable, double position) {
  const VariableLimits limits = variable_limits(tree, variable);
  const double allowed = std::max(kBeyond * (limits.upper - limits.lower), kBeyondNarrow);
  const auto fits = [&](double value) {
    return value >= limits.lower - allowed && value <= limits.upper + allowed;
  };
  if (!std::isfinite(position) || fits(position)) return "";
  const auto index = tree.variable_joint[static_cast<std::size_t>(variable)];
  const Joint& joint = tree.joints[static_cast<std::size_t>(index)];
  const bool slides = joint.type == JointType::prismatic;
  const bool fits_otherwise = fits(position * (slides ? 1.0 / kMillimetres : kRadians));
  return "puts joint '" + joint.name + "' to " + readable_number(position) +
         ", far beyond its limits, " + readable_number(limits.lower) + " to " +
         readable_number(limits.upper) + "; " + advice(slides, fits_otherwise);
}

std::string problem_of(const KinematicTree& tree, const Configuration& configuration) {
  std::string problem = problem_of_base(configuration);
  for (int v = 0; v < tree.variables() && problem.empty(); ++v) {
    problem = problem_of_joint(tree, v, configuration.q[v]);
  }
  return problem;
}

}  // namespace

std::string implausibility(const KinematicTree& tree, const std::vector<State>& states) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!states[i].known) continue;
    const std::string problem = problem_of(tree, states[i].configuration);
    if (!problem.empty()) return "state " + std::to_string(i + 1) + " " + problem;
  }
  return "";
}

void require_plausible(const std::string& file, const KinematicTree& tree,
                       const std::vector<State>& states) {
  const std::string problem = implausibility(tree, states);
  if (!problem.empty()) throw InputError(file, problem);
}

void require_increasing_stamps(const std::string& file, const std::vector<State>& states) {
  if (states.empty()) throw InputError(file, "holds no states");
  for (std::size_t i = 1; i < states.size(); ++i) {
    if (states[i].stamp <= states[i - 1].stamp) {
      throw InputError(file, "timestamps must increase, that of state " + std::to_string(i + 1) +
                                 " (" + std::to_string(states[i].stamp) + ") does not");
    }
  }
}

}  // namespace lockbox::app
