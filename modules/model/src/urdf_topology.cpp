// SPDX-License-Identifier: BSD-3-Clause
#include "urdf_topology.hpp"

#include <map>
#include <optional>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

using LinkByName = std::map<std::string, const UrdfLink*>;
using JointByName = std::map<std::string, const UrdfJoint*>;

[[noreturn]] void refuse_joint(const std::string& file, const UrdfJoint& joint,
                               const std::string& problem) {
  throw InputError(file, joint.line, "joint '" + joint.name + "': " + problem);
}

[[noreturn]] void refuse_link(const std::string& file, const UrdfLink& link,
                              const std::string& problem) {
  throw InputError(file, link.line, "link '" + link.name + "': " + problem);
}

LinkByName links_by_name(const std::string& file, const std::vector<UrdfLink>& links) {
  LinkByName by_name;
  for (const UrdfLink& link : links) {
    const auto [first, is_new] = by_name.emplace(link.name, &link);
    if (!is_new) {
      refuse_link(file, link,
                  "the name is taken by the link in line " + std::to_string(first->second->line) +
                      "; rename one of them");
    }
  }
  return by_name;
}

JointByName joints_by_name(const std::string& file, const std::vector<UrdfJoint>& joints) {
  JointByName by_name;
  for (const UrdfJoint& joint : joints) {
    const auto [first, is_new] = by_name.emplace(joint.name, &joint);
    if (!is_new) {
      refuse_joint(file, joint,
                   "the name is taken by the joint in line " + std::to_string(first->second->line) +
                       "; rename one of them");
    }
  }
  return by_name;
}

/// The joint above each link that has one.
JointByName joint_above(const std::string& file, const LinkByName& links,
                        const std::vector<UrdfJoint>& joints) {
  JointByName above;
  for (const UrdfJoint& joint : joints) {
    for (const std::string& link : {joint.parent, joint.child}) {
      if (links.count(link) == 0) {
        refuse_joint(file, joint, "there is no link '" + link + "'; define it or correct the name");
      }
    }
    if (joint.parent == joint.child) {
      refuse_joint(file, joint, "connects link '" + joint.parent + "' with itself");
    }
    const auto [first, is_new] = above.emplace(joint.child, &joint);
    if (!is_new) {
      refuse_joint(file, joint,
                   "its child '" + joint.child + "' is already the child of joint '" +
                       first->second->name + "' (line " + std::to_string(first->second->line) +
                       "); only trees are tracked, so remove one of the joints");
    }
  }
  return above;
}

void check_only_root(const std::string& file, const std::vector<UrdfLink>& links,
                     const JointByName& above) {
  const UrdfLink* root = nullptr;
  for (const UrdfLink& link : links) {
    if (above.count(link.name) != 0) continue;
    if (root != nullptr) {
      refuse_link(file, link,
                  "no joint connects it with link '" + root->name + "' (line " +
                      std::to_string(root->line) + "); add a joint between them");
    }
    root = &link;
  }
}

using NextByName = std::map<std::string, std::string>;

/// A name from which following next leads back to itself, if there is one.
std::optional<std::string> name_on_cycle(const NextByName& next) {
  enum class State { unknown, on_path, free };
  std::map<std::string, State> state;
  for (const auto& [start, ignored] : next) {
    std::vector<std::string> path;
    std::string name = start;
    while (next.count(name) != 0 && state[name] == State::unknown) {
      state[name] = State::on_path;
      path.push_back(name);
      name = next.at(name);
    }
    if (state[name] == State::on_path) return name;
    for (const std::string& passed : path) state[passed] = State::free;
  }
  return std::nullopt;
}

/// With one parent each, a link that does not lead up to the root leads into a cycle.
void refuse_joint_cycles(const std::string& file, const JointByName& above) {
  NextByName parent_of;
  for (const auto& [link, joint] : above) parent_of.emplace(link, joint->parent);
  if (const auto link = name_on_cycle(parent_of)) {
    refuse_joint(file, *above.at(*link),
                 "lies on a cycle of joints; only trees are tracked, so remove one of them");
  }
}

void check_mimics(const std::string& file, const JointByName& joints) {
  NextByName driver_of;
  for (const auto& [name, joint] : joints) {
    if (joint->mimics.empty()) continue;
    const auto driver = joints.find(joint->mimics);
    if (driver == joints.end()) {
      refuse_joint(file, *joint,
                   "mimics joint '" + joint->mimics + "', which does not exist; correct the name");
    }
    if (driver->second->type == "fixed") {
      refuse_joint(file, *joint,
                   "mimics joint '" + joint->mimics + "', which is fixed; mimic a movable joint");
    }
    driver_of.emplace(name, joint->mimics);
  }
  if (const auto name = name_on_cycle(driver_of)) {
    refuse_joint(file, *joints.at(*name),
                 "mimics itself, directly or through other joints; one joint of the circle must "
                 "not mimic");
  }
}

}  // namespace

void check_topology(const std::string& file, const std::vector<UrdfLink>& links,
                    const std::vector<UrdfJoint>& joints) {
  if (links.empty()) throw InputError(file, "the robot has no <link>; it needs one at least");
  const LinkByName link_by_name = links_by_name(file, links);
  const JointByName joint_by_name = joints_by_name(file, joints);
  const JointByName above = joint_above(file, link_by_name, joints);
  refuse_joint_cycles(file, above);
  check_only_root(file, links, above);
  check_mimics(file, joint_by_name);
}

}  // namespace lockbox
