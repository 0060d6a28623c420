// SPDX-License-Identifier: BSD-3-Clause
#include "surface_pairs.hpp"

#include <algorithm>
#include <optional>

#include "lockbox/sdf/signed_distance_field.hpp"

namespace lockbox {
namespace {

/// Box of everything in the camera's frame that is within reach of the model.
Eigen::AlignedBox3f reachable(const ArticulatedModel& model,
                              const std::vector<Eigen::Isometry3d>& T_camera_body, double reach) {
  Eigen::AlignedBox3d box;
  for (std::size_t b = 0; b < model.fields.size(); ++b) {
    if (model.fields[b]) {
      box.extend(model.fields[b]->bounds().transformed(T_camera_body[b]));
    }
  }
  box.min().array() -= reach;
  box.max().array() += reach;
  return box.cast<float>();
}

/// Nothing if all bodies are farther away than reach.
std::optional<SurfacePair> nearest_surface(const ArticulatedModel& model,
                                           const std::vector<Eigen::Isometry3f>& T_body_camera,
                                           const Eigen::Vector3f& p_camera, float reach) {
  std::optional<SurfacePair> nearest;
  float best = reach * reach;
  for (std::size_t b = 0; b < model.fields.size(); ++b) {
    if (!model.fields[b]) {
      continue;
    }
    const Eigen::Vector3f p_body = T_body_camera[b] * p_camera;
    const Eigen::AlignedBox3f box = model.fields[b]->bounds().cast<float>();
    if (box.squaredExteriorDistance(p_body) > best) {
      continue;  // spares the look-up
    }
    const float distance = model.fields[b]->sample(p_body).distance;
    if (distance * distance <= best) {
      best = distance * distance;
      nearest = SurfacePair{0, b, p_body, best};
    }
  }
  return nearest;
}

}  // namespace

std::vector<SurfacePair> surface_pairs(const ArticulatedModel& model,
                                       const std::vector<Eigen::Isometry3d>& T_camera_body,
                                       const PointTiles& points, double reach,
                                       std::size_t max_pairs) {
  const Eigen::AlignedBox3f box = reachable(model, T_camera_body, reach);
  std::vector<const Tile*> tiles;
  std::size_t count = 0;
  for (const Tile& tile : points.tiles()) {
    if (tile.count > 0 && box.intersects(tile.bounds)) {
      tiles.push_back(&tile);
      count += tile.count;
    }
  }
  std::vector<Eigen::Isometry3f> T_body_camera;
  T_body_camera.reserve(T_camera_body.size());
  for (const Eigen::Isometry3d& T : T_camera_body) {
    T_body_camera.push_back(T.inverse().cast<float>());
  }
  const std::size_t stride = std::max<std::size_t>(1, (count + max_pairs - 1) / max_pairs);
  std::vector<SurfacePair> pairs;
  std::size_t next = 0;  // within the tile
  for (const Tile* const tile : tiles) {
    for (; next < tile->count; next += stride) {
      const std::size_t i = tile->first + next;
      std::optional<SurfacePair> pair =
          nearest_surface(model, T_body_camera, {points.x()[i], points.y()[i], points.z()[i]},
                          static_cast<float>(reach));
      if (pair) {
        pair->point = points.pixel()[i];
        pairs.push_back(*pair);
      }
    }
    next -= tile->count;
  }
  return pairs;
}

}  // namespace lockbox
