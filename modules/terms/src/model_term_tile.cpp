// SPDX-License-Identifier: BSD-3-Clause
// The model term of one tile of points.
#include <algorithm>
#include <span>
#include <utility>

#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/terms/model_term.hpp"
#include "model_term_scratch.hpp"

namespace lockbox {
namespace {

kernels::PointSpan points_of(const PointTiles& points, const Tile& tile) {
  return {points.x().data() + tile.first, points.y().data() + tile.first,
          points.z().data() + tile.first, tile.padded};
}

kernels::PointNoise point_noise(const SensorNoise& noise, const PinholeCamera& camera,
                                double annealing_sigma) {
  return {static_cast<float>(noise.depth_floor), static_cast<float>(noise.depth_quadratic),
          static_cast<float>(noise.lateral_pixels / camera.fx), static_cast<float>(annealing_sigma),
          static_cast<float>(noise.depth_linear)};
}

kernels::PredictedPixels predicted_pixels(const ModelTerm::Scene& scene, const Tile& tile) {
  return {scene.predicted.body.data() + tile.first, scene.predicted.depth.data() + tile.first};
}

/// The sum of that body, zero at first.
BodySystem& sum_of(std::vector<std::pair<int, BodySystem>>& sums, int body) {
  const auto found =
      std::find_if(sums.begin(), sums.end(), [body](const auto& sum) { return sum.first == body; });
  return found != sums.end() ? found->second : sums.emplace_back(body, BodySystem{}).second;
}

}  // namespace

kernels::BodyPlanes ModelTerm::Chunk::planes_of(std::size_t tile_of_chunk) const {
  float* const offset = planes.get() + tile_of_chunk * kPlaneNumbers * kTilePoints;
  return {offset, {offset + kTilePoints, offset + 2 * kTilePoints, offset + 3 * kTilePoints}};
}

/// Where a tile's points see the body, and which planes they see in place of its nearest surface.
void ModelTerm::look_up(const Scene& scene, std::size_t tile_index, std::size_t tile_of_chunk,
                        std::size_t candidate, const kernels::FieldHits& hits, Chunk& chunk) const {
  const Tile& tile = scene.points.tiles()[tile_index];
  const int body = chunk.bodies[candidate];
  const auto b = static_cast<std::size_t>(body);
  kernels::look_up(scene.model.fields[b]->view(), bodies_[b].from_camera,
                   point_noise(scene.options.noise, scene.camera, chunk.annealing_sigma),
                   points_of(scene.points, tile), predicted_pixels(scene, tile),
                   static_cast<float>(body), static_cast<float>(scene.options.gate), hits,
                   chunk.planes_of(tile_of_chunk), chunk.has_planes[tile_of_chunk]);
}

/// What the candidates' look-ups, in the scratch memory, say of the tile.
void ModelTerm::linearize_tile(const Scene& scene, std::size_t tile_index,
                               std::size_t tile_of_chunk, Scratch& scratch, Chunk& chunk) const {
  const Tile& tile = scene.points.tiles()[tile_index];
  const std::size_t first = chunk.first[tile_of_chunk];
  const std::size_t count = chunk.first[tile_of_chunk + 1] - first;
  if (count == 0) {
    return;
  }
  for (std::size_t l = 0; l < count; ++l) {
    scratch.distance[l] = scratch.hits[l].distance;
  }
  chunk.cost +=
      tile.weight * kernels::associate(scratch.candidates(scene, chunk, first, count, tile),
                                       {scratch.weight.data(), count});
  for (std::size_t l = 0; l < count; ++l) {
    const int body = chunk.bodies[first + l];
    const kernels::NormalSums tile_sums =
        kernels::accumulate(tile.padded, scratch.hits[l], scratch.weight[l]);
    const BodySystem system = to_system(tile_sums, tile.weight, kNormalVariance);
    sum_of(chunk.sums, body) += system;
    const Eigen::Vector3d camera =
        bodies_[static_cast<std::size_t>(body)].T_body_camera.translation();
    const Eigen::Vector3d seen = Eigen::Vector3d(tile_sums.first_moment) - tile_sums.mass * camera;
    chunk.tile_systems[first + l] = {tile_index,        body,           tile.weight,
                                     seen.normalized(), system.hessian, system.gradient};
    chunk.totals.weighted_squares +=
        tile.weight * (tile_sums.weighted_squares + tile.scatter * tile_sums.weight);
    chunk.totals.points += tile.weight * tile_sums.weight;
  }
}

/// The distances that the body's look-up in a tile has left, if it is a candidate there.
const float* ModelTerm::nearest_of(const Chunk& chunk, std::size_t tile_of_chunk, int body,
                                   std::span<const kernels::FieldHits> hits) {
  const auto begin = chunk.bodies.begin();
  const auto from = begin + static_cast<std::ptrdiff_t>(chunk.first[tile_of_chunk]);
  const auto to = begin + static_cast<std::ptrdiff_t>(chunk.first[tile_of_chunk + 1]);
  const auto found = std::find(from, to, body);
  return found != to ? hits[static_cast<std::size_t>(found - from)].nearest : nullptr;
}

double ModelTerm::frozen_cost(const Scene& scene, std::size_t tile_index, std::size_t tile_of_chunk,
                              const Chunk& frozen, const Chunk* current, Scratch& scratch) const {
  const std::size_t first = frozen.first[tile_of_chunk];
  const std::size_t count = frozen.first[tile_of_chunk + 1] - first;
  if (count == 0) {
    return 0.0;
  }
  const Tile& tile = scene.points.tiles()[tile_index];
  for (std::size_t l = 0; l < count; ++l) {
    const int body = frozen.bodies[first + l];
    const auto b = static_cast<std::size_t>(body);
    const float* nearest =
        current != nullptr ? nearest_of(*current, tile_of_chunk, body, scratch.hits) : nullptr;
    if (nearest == nullptr) {
      kernels::look_up_distance(scene.model.fields[b]->view(), bodies_[b].from_camera,
                                points_of(scene.points, tile), scratch.frozen_distance[l]);
      nearest = scratch.frozen_distance[l];
    }
    scratch.distance[l] = nearest;
    if (frozen.has_planes[tile_of_chunk]) {
      kernels::frozen_distance(bodies_[b].from_camera, points_of(scene.points, tile),
                               predicted_pixels(scene, tile), static_cast<float>(body),
                               frozen.planes_of(tile_of_chunk), nearest,
                               scratch.frozen_distance[l]);
      scratch.distance[l] = scratch.frozen_distance[l];
    }
  }
  return tile.weight *
         kernels::association_cost(scratch.candidates(scene, frozen, first, count, tile));
}

}  // namespace lockbox
