// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/simulation/scene.hpp"

namespace lockbox {

std::filesystem::path shipped_file(const std::string& name);

/// Fields come from the build's cache.
LoadOptions with_cache();

/// The shipped model of that name.
const ArticulatedModel& shipped(const std::string& name);

/// At rest, in front of the camera, tilted to its left and rolled, radians.
Configuration facing(const ArticulatedModel& model, double distance, double tilt, double roll);

/// What a PrimeSense-class sensor sees of the model in the scene. Frames with other numbers have
/// other noise.
DepthFrame seen_frame(const ArticulatedModel& model, const Configuration& truth, const Scene& scene,
                      std::uint64_t number = 0);
TiledCloud seen(const ArticulatedModel& model, const Configuration& truth, const Scene& scene,
                std::uint64_t number = 0);

/// A wall that many metres behind the base's origin, square to the base.
Scene wall_behind(double distance);

}  // namespace lockbox
