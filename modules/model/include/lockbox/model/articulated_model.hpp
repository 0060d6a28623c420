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

#include "lockbox/core/stop_request.hpp"
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
  std::optional<Configuration> initial_configuration;  ///< where to begin, if the file says so
};

/// How a model is read.
struct LoadOptions {
  /// Beside those that ROS_PACKAGE_PATH, AMENT_PREFIX_PATH and the like name.
  std::vector<std::filesystem::path> package_paths;
  /// Metres a unit of the mesh files; the scale that a URDF gives a mesh is applied as well.
  double mesh_scale = 1.0;
  std::optional<std::filesystem::path> cache_directory;  ///< default: XDG cache; empty: no cache
  /// Told what looks wrong but is usable.
  std::function<void(const std::string&)> on_warning;
  StopRequest stop_request;  ///< Stopped is thrown then; nothing of the model is left but its cache
};

/// All that is known of an object before it is seen. It is not changed once it was loaded.
struct ArticulatedModel {
  std::filesystem::path file;  ///< that it was read from
  /// The mesh of a body of many triangles, but not its visuals, is simplified as long as it stays
  /// within a voxel of the field: it is drawn many times a frame.
  KinematicTree tree;
  ModelParameters parameters;  ///< from the file beside it
  /// fields[b] belongs to tree.bodies[b]; empty for bodies without geometry.
  std::vector<std::optional<SignedDistanceField>> fields;
  /// Unit axes in the base's frame about which the body of the base is round, as a bottle's is: its
  /// surface does not tell how far it is turned about them. One, or those of a ball.
  std::vector<Eigen::Vector3d> round_axes;
};

/// Reads the URDF (or a bare .obj/.stl/.ply: one body) with its meshes, without fields.
/// Throws InputError naming file, line where known, and link or joint; also for a body of more than
/// 20 m, whose lengths are hardly in metres. Warns of units that seem wrong, and of joints that
/// cannot move.
KinematicTree load_kinematic_tree(const std::filesystem::path& file,
                                  const LoadOptions& options = {});

/// Reads the model and builds its fields, or takes them from the cache. Throws InputError, also
/// where all fields together would take more than 2 GB.
ArticulatedModel load_model(const std::filesystem::path& file, const LoadOptions& options = {});

}  // namespace lockbox
