// SPDX-License-Identifier: BSD-3-Clause
// How far points lie before or behind the surface of a model.
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "lockbox/model/articulated_model.hpp"
#include "lockbox/visualization/scene_window.hpp"

namespace lockbox {

/// What model_distances() gives where no body is within the limit.
inline constexpr float kFarFromModel = std::numeric_limits<float>::infinity();

/// Signed distance of each point (camera frame, metres) to the nearest body, negative inside of it:
/// at most limit, or kFarFromModel. The poses are those of forward_kinematics().
void model_distances(const ArticulatedModel& model,
                     const std::vector<Eigen::Isometry3d>& T_camera_body,
                     const std::vector<Eigen::Vector3f>& p_camera, float limit,
                     std::vector<float>& distances);

/// What nearest_bodies() gives where no body is within the limit.
inline constexpr int kNoBody = -1;

/// The index of the body that is nearest to each point, as model_distances() has them.
void nearest_bodies(const ArticulatedModel& model,
                    const std::vector<Eigen::Isometry3d>& T_camera_body,
                    const std::vector<Eigen::Vector3f>& p_camera, float limit,
                    std::vector<int>& bodies);

/// Red behind the surface (negative), white on it, blue in front; the colours end at +-limit.
/// Red, green, blue in [0, 1].
Eigen::Vector3f distance_color(float distance, float limit);

/// The colours in millimetres, as a scale from -limit to limit (metres).
std::vector<ScaleColor> distance_scale(float limit);

}  // namespace lockbox
