// SPDX-License-Identifier: BSD-3-Clause
// How things of a household are put together, and which there are.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lockbox/simulation/object_draft.hpp"
#include "lockbox/simulation/random_draws.hpp"

namespace lockbox::simulation {

using Vector = Eigen::Vector3d;

inline const Vector kX = Vector::UnitX();
inline const Vector kY = Vector::UnitY();
inline const Vector kZ = Vector::UnitZ();

/// Links are named as they are added, the base first; a joint is named like its child.
class HouseholdDraft {
 public:
  HouseholdDraft(std::string name, std::vector<DraftPart> base) {
    draft_.name = std::move(name);
    draft_.links.push_back({"base", std::move(base)});
  }

  /// How a link moves in its parent's frame.
  struct Motion {
    JointType type;
    Eigen::Vector3d origin;  ///< metres
    Eigen::Vector3d axis;
    double lower = 0.0;  ///< metres or radians
    double upper = 0.0;
  };

  HouseholdDraft& add(const std::string& name, const std::string& parent, const Motion& motion,
                      std::vector<DraftPart> parts) {
    draft_.links.push_back({name, std::move(parts)});
    draft_.joints.push_back(
        {name, motion.type, name, motion.origin, motion.axis, motion.lower, motion.upper, parent});
    return *this;
  }

  ObjectDraft draft() && { return std::move(draft_); }

 private:
  ObjectDraft draft_;
};

inline HouseholdDraft::Motion hinge(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis,
                                    double lower, double upper) {
  return {JointType::revolute, origin, axis, lower, upper};
}
inline HouseholdDraft::Motion slide(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis,
                                    double upper) {
  return {JointType::prismatic, origin, axis, 0.0, upper};
}
inline HouseholdDraft::Motion spin(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis) {
  return {JointType::continuous, origin, axis};
}

/// Walls about a room that is open to one side: towards -y, or upwards. size: outside, its foot at
/// z = 0; metres.
std::vector<DraftPart> case_open_to_front(const Eigen::Vector3d& size, double wall);
std::vector<DraftPart> case_open_to_top(const Eigen::Vector3d& size, double wall);

using DrawHousehold = ObjectDraft (*)(RandomDraws&);

/// Returns the kinds to tune with: laptop, box, rule, lamp, microwave, chair, safe, levers,
/// toolbox, pliers, arm, tripod.
std::span<const DrawHousehold> tuning_household();
/// Returns the kinds of test blocks: vise, gripper, printer, monitor, camera, oven, suitcase, fan,
/// press, window, stapler, stool.
std::span<const DrawHousehold> test_household();

}  // namespace lockbox::simulation
