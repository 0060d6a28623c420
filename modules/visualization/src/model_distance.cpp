// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/model_distance.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/core/units.hpp"
#include "lockbox/sdf/signed_distance_field.hpp"

namespace lockbox {
namespace {

/// Lowers distances to that of one body, where it is near enough, and tells of which points.
template <typename Lowered>
void lower_to_body(const SignedDistanceField& field, const Eigen::Isometry3f& T_body_camera,
                   const std::vector<Eigen::Vector3f>& p_camera, float limit,
                   std::vector<float>& distances, Lowered&& lowered) {
  const Eigen::Vector3f margin = Eigen::Vector3f::Constant(limit);
  const Eigen::AlignedBox3f surface = field.bounds().cast<float>();
  const Eigen::AlignedBox3f near(surface.min() - margin, surface.max() + margin);
  for (std::size_t i = 0; i < p_camera.size(); ++i) {
    const Eigen::Vector3f p_body = T_body_camera * p_camera[i];
    if (!near.contains(p_body)) continue;
    const float distance = field.sample(p_body).distance;
    if (distance > limit || distance >= distances[i]) continue;
    distances[i] = distance;
    lowered(i);
  }
}

/// Goes through all bodies that have a field. lowered(point, body): this one is the nearest so far.
template <typename Lowered>
void find_nearest(const ArticulatedModel& model,
                  const std::vector<Eigen::Isometry3d>& T_camera_body,
                  const std::vector<Eigen::Vector3f>& p_camera, float limit,
                  std::vector<float>& distances, Lowered&& lowered) {
  distances.assign(p_camera.size(), kFarFromModel);
  for (std::size_t body = 0; body < model.fields.size(); ++body) {
    if (!model.fields[body]) continue;
    const Eigen::Isometry3f T_body_camera = T_camera_body[body].inverse().cast<float>();
    lower_to_body(*model.fields[body], T_body_camera, p_camera, limit, distances,
                  [&](std::size_t i) { lowered(i, static_cast<int>(body)); });
  }
}

}  // namespace

void model_distances(const ArticulatedModel& model,
                     const std::vector<Eigen::Isometry3d>& T_camera_body,
                     const std::vector<Eigen::Vector3f>& p_camera, float limit,
                     std::vector<float>& distances) {
  find_nearest(model, T_camera_body, p_camera, limit, distances, [](std::size_t, int) {});
}

void nearest_bodies(const ArticulatedModel& model,
                    const std::vector<Eigen::Isometry3d>& T_camera_body,
                    const std::vector<Eigen::Vector3f>& p_camera, float limit,
                    std::vector<int>& bodies) {
  bodies.assign(p_camera.size(), kNoBody);
  std::vector<float> distances;
  find_nearest(model, T_camera_body, p_camera, limit, distances,
               [&bodies](std::size_t point, int body) { bodies[point] = body; });
}

Eigen::Vector3f distance_color(float distance, float limit) {
  const Eigen::Vector3f on_surface(0.97F, 0.97F, 0.95F);
  const Eigen::Vector3f behind(0.86F, 0.10F, 0.12F);
  const Eigen::Vector3f in_front(0.10F, 0.36F, 0.90F);
  const float share = std::min(std::abs(distance) / limit, 1.0F);
  return on_surface + share * ((distance < 0.0F ? behind : in_front) - on_surface);
}

std::vector<ScaleColor> distance_scale(float limit) {
  constexpr int kSteps = 20;  // on each side
  std::vector<ScaleColor> scale;
  for (int step = -kSteps; step <= kSteps; ++step) {
    const float distance = limit * static_cast<float>(step) / kSteps;
    scale.push_back(
        {kMillimetres * static_cast<double>(distance), distance_color(distance, limit)});
  }
  return scale;
}

}  // namespace lockbox
