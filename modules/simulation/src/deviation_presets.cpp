// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/deviation_presets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lockbox/core/error.hpp"
#include "lockbox/simulation/deviating_model.hpp"
#include "lockbox/simulation/random_draws.hpp"

namespace lockbox {
namespace {

DeviationAmounts weakened(DeviationAmounts amounts, double factor) {
  for (double* amount : {&amounts.scale, &amounts.sizes, &amounts.bend, &amounts.joint_origins,
                         &amounts.joint_axes, &amounts.added_share, &amounts.focal_length,
                         &amounts.principal_point, &amounts.k1, &amounts.k2, &amounts.depth_scale,
                         &amounts.depth_bend, &amounts.depth_corners, &amounts.repeated}) {
    *amount *= factor;
  }
  amounts.added_parts = static_cast<int>(std::lround(amounts.added_parts * factor));
  amounts.rate = 0.0;
  return amounts;
}

/// All kinds at once; the seed decides signs and directions.
Deviation whole_deviation(const DeviationAmounts& amounts, std::uint64_t seed) {
  constexpr std::uint64_t kPresetPurpose = 200;  // tells this use of the seed from others
  RandomDraws random(seed, kPresetPurpose);
  const auto sign = [&] { return random.chance(0.5) ? 1.0 : -1.0; };
  Deviation all;
  all.seed = seed;
  all.object.scale += sign() * amounts.scale;
  all.object.sizes = amounts.sizes;
  all.object.bend = amounts.bend;
  all.object.joint_origins = amounts.joint_origins;
  all.object.joint_axes = amounts.joint_axes;
  all.object.added_parts = amounts.added_parts;
  all.object.added_share = amounts.added_share;
  all.sensor.camera.focal_length += sign() * amounts.focal_length;
  const double direction = random.uniform(-std::numbers::pi, std::numbers::pi);
  all.sensor.camera.principal_point =
      amounts.principal_point * Eigen::Vector2d(std::cos(direction), std::sin(direction));
  all.sensor.camera.distortion = {amounts.k1, amounts.k2};
  all.sensor.depth.scale += sign() * amounts.depth_scale;
  const double bend = sign();
  all.sensor.depth.bend = bend * amounts.depth_bend;
  all.sensor.depth.corners = bend * amounts.depth_corners;
  all.frames = {amounts.rate, amounts.repeated, amounts.missing};
  return all;
}

/// What is missing of the model; false if it has nothing that could be.
bool draw_missing(Severity severity, const KinematicTree& tree, ObjectDeviation& object,
                  std::uint64_t seed) {
  if (severity == Severity::moderate) {
    object.missing_handles = 1;
    return count_handles(tree) > 0;
  }
  std::vector<std::string> parts;
  for (std::size_t b = 1; b < tree.bodies.size(); ++b) {
    if (!tree.bodies[b].mesh.triangles.empty()) parts.push_back(tree.bodies[b].name);
  }
  if (parts.empty()) return false;
  object.missing_parts = {parts[seed % parts.size()]};
  return true;
}

}  // namespace

const std::vector<std::string>& deviation_kinds() {
  static const std::vector<std::string> kinds = {
      "none",  "scale",  "sizes",      "bend",        "joints",     "added",  "missing",
      "focal", "centre", "distortion", "depth-scale", "depth-bend", "frames", "all"};
  return kinds;
}

std::optional<Deviation> preset_deviation(const std::string& kind, Severity severity,
                                          std::uint64_t seed, const KinematicTree& tree) {
  const bool is_severe = severity == Severity::severe;
  if (kind == "all") {
    return whole_deviation(weakened(kModerateDeviation, is_severe ? 1.0 / 2.0 : 1.0 / 3.0), seed);
  }
  const Deviation all = whole_deviation(is_severe ? kSevereDeviation : kModerateDeviation, seed);
  Deviation one;
  one.seed = seed;
  if (kind == "scale") {
    one.object.scale = all.object.scale;
  } else if (kind == "sizes") {
    one.object.sizes = all.object.sizes;
  } else if (kind == "bend") {
    one.object.bend = all.object.bend;
  } else if (kind == "joints") {
    one.object.joint_origins = all.object.joint_origins;
    one.object.joint_axes = all.object.joint_axes;
    if (tree.joints.empty()) return std::nullopt;
  } else if (kind == "added") {
    one.object.added_parts = all.object.added_parts;
    one.object.added_share = all.object.added_share;
  } else if (kind == "missing") {
    if (!draw_missing(severity, tree, one.object, seed)) return std::nullopt;
  } else if (kind == "focal") {
    one.sensor.camera.focal_length = all.sensor.camera.focal_length;
  } else if (kind == "centre") {
    one.sensor.camera.principal_point = all.sensor.camera.principal_point;
  } else if (kind == "distortion") {
    one.sensor.camera.distortion = all.sensor.camera.distortion;
  } else if (kind == "depth-scale") {
    one.sensor.depth.scale = all.sensor.depth.scale;
  } else if (kind == "depth-bend") {
    one.sensor.depth.bend = all.sensor.depth.bend;
    one.sensor.depth.corners = all.sensor.depth.corners;
  } else if (kind == "frames") {
    one.frames = all.frames;
  } else if (kind != "none") {
    throw InputError("deviation '" + kind + "'", "is none of the kinds that there are");
  }
  return one;
}

}  // namespace lockbox
