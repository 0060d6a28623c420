// SPDX-License-Identifier: BSD-3-Clause
// A model ready for tracking: kinematic tree, one distance field per body, tracking parameters.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lockbox/model/configuration.hpp"
#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/sdf/signed_distance_field.hpp"

namespace lockbox {

/// Per-model parameters, from the YAML file beside the URDF with the same stem. The file may name a
/// body by any of its links.
struct ModelParameters {
  std::optional<double> voxel;               ///< metres; chosen per body if not set
  std::map<std::string, double> link_voxel;  ///< metres, overrides by name of the body
  std::optional<double> erosion;             ///< metres, model-wide
  /// metres, by the names of two bodies, sorted
  std::map<std::pair<std::string, std::string>, double> pair_erosion;
  std::optional<Configuration> initial_configuration;
};

struct LoadOptions {
  std::vector<std::filesystem::path> package_paths;      ///< beside ROS_PACKAGE_PATH
  std::optional<std::filesystem::path> cache_directory;  ///< default: XDG cache; empty: no cache
  std::function<void(const std::string&)> on_warning;
};

struct ArticulatedModel {
  std::filesystem::path file;
  /// The mesh of a body of many triangles, but not its visuals, is simplified as long as it stays
  /// within a voxel of the field: it is drawn many times a frame.
  KinematicTree tree;
  ModelParameters parameters;
  /// fields[b] belongs to tree.bodies[b]; empty for bodies without geometry.
  std::vector<std::optional<SignedDistanceField>> fields;
};

/// Reads the URDF (or a bare .obj/.stl: one body) with its meshes, without fields.
/// Throws InputError naming file, line where known, and link or joint.
KinematicTree load_kinematic_tree(const std::filesystem::path& file,
                                  const LoadOptions& options = {});

/// Reads the model and builds its fields, or takes them from the cache.
ArticulatedModel load_model(const std::filesystem::path& file, const LoadOptions& options = {});

}  // namespace lockbox
