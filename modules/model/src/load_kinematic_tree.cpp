// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "canonical_order.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/mesh/load_mesh.hpp"
#include "lockbox/mesh/mesh_audit.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "mesh_locator.hpp"
#include "rigid_bodies.hpp"
#include "text_file.hpp"
#include "urdf_guard.hpp"
#include "urdf_reader.hpp"

namespace lockbox {
namespace {

using JointByName = std::map<std::string, int>;

JointByName joints_by_name(const KinematicTree& tree) {
  JointByName by_name;
  for (const Joint& joint : tree.joints) by_name.emplace(joint.name, joint.child_body - 1);
  return by_name;
}

/// Gives every joint its variable; a chain of mimics becomes one multiplier and one offset.
void assign_variables(KinematicTree& tree, const JointByName& by_name,
                      const std::map<std::string, std::string>& mimics) {
  const auto joint_called = [&](const std::string& name) -> Joint& {
    return tree.joints[static_cast<std::size_t>(by_name.at(name))];
  };
  for (Joint& joint : tree.joints) {
    if (joint.is_mimic) continue;
    joint.variable = tree.variables();
    tree.variable_joint.push_back(joint.child_body - 1);
  }
  for (const auto& [name, first_driver] : mimics) {
    std::vector<Joint*> chain{&joint_called(name)};
    while (chain.back()->variable < 0)
      chain.push_back(&joint_called(mimics.at(chain.back()->name)));
    for (std::size_t i = chain.size() - 1; i-- > 0;) {
      const Joint& driver = *chain[i + 1];
      chain[i]->variable = driver.variable;
      chain[i]->offset += chain[i]->multiplier * driver.offset;
      chain[i]->multiplier *= driver.multiplier;
    }
  }
}

/// The limits of a variable and its mimics must leave it a position.
void check_limits(const KinematicTree& tree, const std::string& file, const GuardedUrdf& urdf) {
  const auto refuse = [&](const Joint& joint, const std::string& problem) {
    throw InputError(file, urdf.joint_lines.at(joint.name),
                     "joint '" + joint.name + "': " + problem);
  };
  for (const Joint& joint : tree.joints) {
    if (!std::isfinite(joint.multiplier) || !std::isfinite(joint.offset)) {
      refuse(joint, "multiplier or offset of its chain of mimics is beyond all numbers");
    }
  }
  for (int v = 0; v < tree.variables(); ++v) {
    const VariableLimits limits = variable_limits(tree, v);
    if (limits.lower <= limits.upper) continue;
    const int driver = tree.variable_joint[static_cast<std::size_t>(v)];
    refuse(tree.joints[static_cast<std::size_t>(driver)],
           "its limits and those of its mimics exclude each other; widen them");
  }
}

KinematicTree read_urdf_tree(const std::filesystem::path& path, const LoadOptions& options) {
  const std::string file = path.string();
  const GuardedUrdf guarded = guard_urdf(file, read_text_file(path));
  const auto urdf = read_urdf(file, guarded.text);
  const auto refuse_link = [&](const std::string& link, const std::string& problem) {
    throw InputError(file, guarded.link_lines.at(link), "link '" + link + "': " + problem);
  };
  RigidBodies rigid = in_canonical_order(
      assemble_rigid_bodies(*urdf, MeshLocator(path, options.package_paths), refuse_link));

  KinematicTree tree;
  tree.name = urdf->getName();
  tree.bodies = std::move(rigid.bodies);
  tree.joints = std::move(rigid.joints);
  const JointByName by_name = joints_by_name(tree);
  assign_variables(tree, by_name, rigid.mimics);
  for (const std::string& joint : guarded.movable_joints) {
    tree.file_order.push_back(by_name.at(joint));
  }
  check_limits(tree, file, guarded);
  if (options.on_warning && !guarded.collision_only_links.empty()) {
    std::string links;
    for (const std::string& link : guarded.collision_only_links) {
      links += (links.empty() ? "'" : ", '") + link + "'";
    }
    options.on_warning(
        file + ": links with <collision> but no <visual> count as without geometry: " + links);
  }
  return tree;
}

KinematicTree read_mesh_tree(const std::filesystem::path& file) {
  KinematicTree tree;
  tree.name = file.stem().string();
  Body& body = tree.bodies.emplace_back();
  body.name = tree.name;
  body.links = {tree.name};
  body.visuals.push_back({load_mesh(file), ColoredMesh{}.rgba});
  body.mesh = body.visuals.front().mesh;
  body.encloses_solid = encloses_solid(body.mesh);
  return tree;
}

std::string lower_case_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

KinematicTree load_kinematic_tree(const std::filesystem::path& file, const LoadOptions& options) {
  const std::string extension = lower_case_extension(file);
  if (extension == ".xacro") {
    throw InputError(file.string(), "is not expanded; run: xacro " + file.filename().string() +
                                        " > " + file.stem().stem().string() + ".urdf");
  }
  const bool is_mesh = extension == ".obj" || extension == ".stl" || extension == ".ply";
  return is_mesh ? read_mesh_tree(file) : read_urdf_tree(file, options);
}

}  // namespace lockbox
