// SPDX-License-Identifier: BSD-3-Clause
#include "model_tile.hpp"

#include <algorithm>
#include <utility>
#include <vector>

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

kernels::BodyPlanes planes_of(const ModelTermChunk& chunk, std::size_t tile_of_chunk) {
  float* const offset =
      chunk.planes.get() + tile_of_chunk * ModelTermChunk::kPlaneNumbers * kTilePoints;
  return {offset, {offset + kTilePoints, offset + 2 * kTilePoints, offset + 3 * kTilePoints}};
}

/// The distances that the body's look-up in a tile has left, if it is a candidate there.
const float* nearest_of(const ModelTermChunk& chunk, std::size_t tile_of_chunk, int body,
                        std::span<const kernels::FieldHits> hits) {
  const auto begin = chunk.bodies.begin();
  const auto from = begin + static_cast<std::ptrdiff_t>(chunk.first[tile_of_chunk]);
  const auto to = begin + static_cast<std::ptrdiff_t>(chunk.first[tile_of_chunk + 1]);
  const auto found = std::find(from, to, body);
  return found != to ? hits[static_cast<std::size_t>(found - from)].nearest : nullptr;
}

/// The sum of that body, zero at first.
BodySystem& sum_of(std::vector<std::pair<int, BodySystem>>& sums, int body) {
  const auto found =
      std::find_if(sums.begin(), sums.end(), [body](const auto& sum) { return sum.first == body; });
  return found != sums.end() ? found->second : sums.emplace_back(body, BodySystem{}).second;
}

}  // namespace

void ModelTile::look_up(ModelTileScratch& scratch, ModelTermChunk& chunk) const {
  chunk.has_planes[tile_of_chunk_] = false;
  for (std::size_t c = chunk.first[tile_of_chunk_]; c < chunk.first[tile_of_chunk_ + 1]; ++c) {
    kernels::FieldHits& hits = scratch.hits[c - chunk.first[tile_of_chunk_]];
    hits.inverse_variance = chunk.inverse_variance.data() + c * kTilePoints;
    const int body = chunk.bodies[c];
    const auto b = static_cast<std::size_t>(body);
    kernels::look_up(scene_.model.fields[b]->view(), bodies_[b].from_camera,
                     point_noise(scene_.options.noise, scene_.camera, chunk.annealing_sigma),
                     points_of(scene_.points, tile()), predicted_pixels(scene_, tile()),
                     static_cast<float>(body), static_cast<float>(scene_.options.gate), hits,
                     planes_of(chunk, tile_of_chunk_), chunk.has_planes[tile_of_chunk_]);
  }
}

void ModelTile::linearize(ModelTileScratch& scratch, ModelTermChunk& chunk) const {
  const Tile& tile = this->tile();
  const std::size_t first = chunk.first[tile_of_chunk_];
  const std::size_t count = chunk.first[tile_of_chunk_ + 1] - first;
  if (count == 0) {
    return;
  }
  for (std::size_t l = 0; l < count; ++l) {
    scratch.distance[l] = scratch.hits[l].distance;
  }
  chunk.cost +=
      tile.weight * kernels::associate(scratch.candidates(scene_, chunk, first, count, tile),
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
    chunk.tile_systems[first + l] = {tile_index_,       body,           tile.weight,
                                     seen.normalized(), system.hessian, system.gradient};
    chunk.totals.weighted_squares +=
        tile.weight * (tile_sums.weighted_squares + tile.scatter * tile_sums.weight);
    chunk.totals.points += tile.weight * tile_sums.weight;
  }
}

double ModelTile::frozen_cost(const ModelTermChunk& frozen, const ModelTermChunk* current,
                              ModelTileScratch& scratch) const {
  const std::size_t first = frozen.first[tile_of_chunk_];
  const std::size_t count = frozen.first[tile_of_chunk_ + 1] - first;
  if (count == 0) {
    return 0.0;
  }
  const Tile& tile = this->tile();
  for (std::size_t l = 0; l < count; ++l) {
    const int body = frozen.bodies[first + l];
    const auto b = static_cast<std::size_t>(body);
    const float* nearest =
        current != nullptr ? nearest_of(*current, tile_of_chunk_, body, scratch.hits) : nullptr;
    if (nearest == nullptr) {
      kernels::look_up_distance(scene_.model.fields[b]->view(), bodies_[b].from_camera,
                                points_of(scene_.points, tile), scratch.frozen_distance[l]);
      nearest = scratch.frozen_distance[l];
    }
    scratch.distance[l] = nearest;
    if (frozen.has_planes[tile_of_chunk_]) {
      kernels::frozen_distance(bodies_[b].from_camera, points_of(scene_.points, tile),
                               predicted_pixels(scene_, tile), static_cast<float>(body),
                               planes_of(frozen, tile_of_chunk_), nearest,
                               scratch.frozen_distance[l]);
      scratch.distance[l] = scratch.frozen_distance[l];
    }
  }
  return tile.weight *
         kernels::association_cost(scratch.candidates(scene_, frozen, first, count, tile));
}

}  // namespace lockbox
