// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "canonical_order.hpp"
#include "foreign_model.hpp"
#include "joint_checks.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/file_kind.hpp"
#include "lockbox/core/text_file.hpp"
#include "lockbox/mesh/load_mesh.hpp"
#include "lockbox/mesh/mesh_audit.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "mesh_locator.hpp"
#include "rigid_bodies.hpp"
#include "size_checks.hpp"
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

void require_finite_mimics(const KinematicTree& tree, const std::string& file,
                           const GuardedUrdf& urdf) {
  for (const Joint& joint : tree.joints) {
    if (std::isfinite(joint.multiplier) && std::isfinite(joint.offset)) continue;
    throw InputError(file, urdf.joint_lines.at(joint.name),
                     "joint '" + joint.name +
                         "': multiplier or offset of its chain of mimics is beyond all numbers");
  }
}

using Warn = std::function<void(const std::string&)>;

/// "file:line: link 'name': "
std::string place_of(const std::string& file, int line, const std::string& kind,
                     const std::string& name) {
  return file + ":" + std::to_string(line) + ": " + kind + " '" + name + "': ";
}

void check_urdf_tree(const std::string& file, const GuardedUrdf& urdf,
                     const std::vector<VisualExtent>& visuals, double mesh_scale, const Warn& warn,
                     KinematicTree& tree) {
  const auto warn_of_joint = [&](const std::string& joint, const std::string& text) {
    warn(place_of(file, urdf.joint_lines.at(joint), "joint", joint) + text);
  };
  const auto warn_of_link = [&](const std::string& link, const std::string& text) {
    warn(place_of(file, urdf.link_lines.at(link), "link", link) + text);
  };
  const auto refuse_link = [&](const std::string& link, const std::string& problem) {
    throw InputError(file, urdf.link_lines.at(link), "link '" + link + "': " + problem);
  };
  set_mimic_limits(urdf.mimic_limits, tree, warn_of_joint);
  check_sizes(visuals, tree, mesh_scale, false, {refuse_link, warn_of_link, warn_of_joint});
  double largest_link = 0.0;
  for (const VisualExtent& visual : visuals) largest_link = std::max(largest_link, visual.size());
  check_limits(tree, largest_link, warn_of_joint);
}

KinematicTree read_urdf_tree(const std::filesystem::path& path, const LoadOptions& options) {
  const std::string file = path.string();
  const GuardedUrdf guarded = guard_urdf(file, read_text_file(path));
  const auto urdf = read_urdf(file, guarded.text);
  const auto refuse_link = [&](const std::string& link, const std::string& problem) {
    throw InputError(file, guarded.link_lines.at(link), "link '" + link + "': " + problem);
  };
  RigidBodies rigid = in_canonical_order(assemble_rigid_bodies(
      *urdf, MeshLocator(path, options.package_paths), options.mesh_scale, refuse_link));

  KinematicTree tree;
  tree.name = urdf->getName();
  tree.bodies = std::move(rigid.bodies);
  tree.joints = std::move(rigid.joints);
  const JointByName by_name = joints_by_name(tree);
  assign_variables(tree, by_name, rigid.mimics);
  for (const std::string& joint : guarded.movable_joints) {
    tree.file_order.push_back(by_name.at(joint));
  }
  require_finite_mimics(tree, file, guarded);
  const Warn warn = options.on_warning ? options.on_warning : [](const std::string&) {};
  for (const std::string& warning : guarded.warnings) warn(warning);
  check_urdf_tree(file, guarded, rigid.extents, options.mesh_scale, warn, tree);
  if (!guarded.collision_only_links.empty()) {
    std::string links;
    for (const std::string& link : guarded.collision_only_links) {
      links += (links.empty() ? "'" : ", '") + link + "'";
    }
    warn(file + ": links with <collision> but no <visual> count as without geometry: " + links);
  }
  return tree;
}

void check_size_of_mesh(const std::filesystem::path& file, const TriangleMesh& mesh,
                        const LoadOptions& options) {
  VisualExtent extent;
  extent.shape = "mesh";
  extent.file = file.filename().string();
  extent.box = bounds(mesh);
  const auto refuse = [&](const std::string&, const std::string& problem) {
    throw InputError(file.string(), problem);
  };
  const auto warn = [&](const std::string&, const std::string& text) {
    if (options.on_warning) options.on_warning(file.string() + ": " + text);
  };
  check_sizes({extent}, KinematicTree{}, options.mesh_scale, true, {refuse, warn, warn});
}

KinematicTree read_mesh_tree(const std::filesystem::path& file, const LoadOptions& options) {
  KinematicTree tree;
  tree.name = file.stem().string();
  Body& body = tree.bodies.emplace_back();
  body.name = tree.name;
  body.links = {tree.name};
  const Eigen::Vector3d scale = Eigen::Vector3d::Constant(options.mesh_scale);
  body.visuals.push_back({load_mesh(file, scale), ColoredMesh{}.rgba});
  body.mesh = body.visuals.front().mesh;
  check_size_of_mesh(file, body.mesh, options);
  body.encloses_solid = encloses_solid(body.mesh);
  return tree;
}

/// Models that the folder holds, for who named the folder instead.
std::string models_in(const std::filesystem::path& folder) {
  constexpr std::size_t kMostNamed = 5;
  std::set<std::string> names;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable)) {
    if (entry.path().extension() == ".urdf") names.insert(entry.path().filename().string());
  }
  if (names.empty()) return "it holds no .urdf; give a URDF, or a .obj, .stl or .ply file";
  std::string list;
  std::size_t named = 0;
  for (const std::string& name : names) {
    if (named++ == kMostNamed) return "give a file in it, such as " + list;
    list += (list.empty() ? "" : ", ") + name;
  }
  return "give the file in it: " + list;
}

void require_sound(const LoadOptions& options) {
  if (std::isfinite(options.mesh_scale) && options.mesh_scale > 0.0) return;
  throw InputError("mesh scale", "it must be a positive number: metres a unit of the mesh files");
}

}  // namespace

KinematicTree load_kinematic_tree(const std::filesystem::path& file, const LoadOptions& options) {
  require_sound(options);
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw InputError(file.string(), "a folder is no model; " + models_in(file));
  }
  const std::string extension = lower_extension(file);
  if (extension == ".xacro") {
    throw InputError(file.string(), "is not expanded; run: xacro " + file.filename().string() +
                                        " > " + file.stem().stem().string() + ".urdf");
  }
  const bool is_mesh = extension == ".obj" || extension == ".stl" || extension == ".ply";
  if (is_mesh) return read_mesh_tree(file, options);
  if (const auto foreign = foreign_model(file)) throw InputError(file.string(), *foreign);
  return read_urdf_tree(file, options);
}

}  // namespace lockbox
