// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/model_term.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/registration/rigid_motion.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kMaxCandidates = 16;  // bodies that may compete for the points of a tile
constexpr std::size_t kArraysPerCandidate = 10;

kernels::PointSpan points_of(const PointTiles& points, const Tile& tile) {
  return {points.x().data() + tile.first, points.y().data() + tile.first,
          points.z().data() + tile.first, tile.padded};
}

kernels::PointNoise point_noise(const SensorNoise& noise, const PinholeCamera& camera,
                                double spread) {
  return {static_cast<float>(noise.depth_floor), static_cast<float>(noise.depth_quadratic),
          static_cast<float>(noise.lateral_pixels / camera.fx), static_cast<float>(spread)};
}

kernels::PredictedPixels predicted_pixels(const ModelTerm::Scene& scene, const Tile& tile) {
  return {scene.predicted.body.data() + tile.first, scene.predicted.depth.data() + tile.first};
}

/// How far from a body, metres, the points of a tile may lie to be its own.
double gate_of(const Tile& tile, const PinholeCamera& camera, const RegistrationOptions& options,
               double spread) {
  const double depth = static_cast<double>(tile.bounds.max().z());
  const double sigma =
      std::max(options.noise.sigma_z(depth), options.noise.sigma_lateral(depth, camera.fx));
  return options.cut * std::hypot(sigma, spread);
}

/// The sum of that body, zero at first.
BodySystem& sum_of(std::vector<std::pair<int, BodySystem>>& sums, int body) {
  const auto found =
      std::find_if(sums.begin(), sums.end(), [body](const auto& sum) { return sum.first == body; });
  return found != sums.end() ? found->second : sums.emplace_back(body, BodySystem{}).second;
}

std::size_t tiles_in_chunk(const PointTiles& points, std::size_t first, std::size_t most) {
  return std::min(most, points.tiles().size() - first);
}

}  // namespace

kernels::BodyPlanes ModelTerm::Chunk::planes_of(std::size_t tile_of_chunk) const {
  float* const offset = planes.get() + tile_of_chunk * kPlaneNumbers * kTilePoints;
  return {offset, {offset + kTilePoints, offset + 2 * kTilePoints, offset + 3 * kTilePoints}};
}

/// Memory for one tile: arrays of all its candidates.
struct ModelTerm::Scratch {
  explicit Scratch(std::vector<float>& memory) {
    memory.resize(kMaxCandidates * kArraysPerCandidate * kTilePoints);
    float* next = memory.data();
    const auto take = [&next] {
      float* array = next;
      next += kTilePoints;
      return array;
    };
    for (std::size_t l = 0; l < kMaxCandidates; ++l) {
      hits[l] = {take(), take(), {take(), take(), take()}, {take(), take(), take()}, nullptr};
      weight[l] = take();
      frozen_distance[l] = take();
    }
  }

  std::array<kernels::FieldHits, kMaxCandidates> hits;  ///< by candidate
  std::array<float*, kMaxCandidates> weight;
  std::array<float*, kMaxCandidates> frozen_distance;

  /// What the candidates of a chunk, from `first` on, have found of a tile.
  kernels::Candidates candidates(const Scene& scene, const Chunk& chunk, std::size_t first,
                                 std::size_t count, const Tile& tile) {
    for (std::size_t l = 0; l < count; ++l) {
      inverse_variance_[l] = chunk.inverse_variance.data() + (first + l) * kTilePoints;
    }
    return {tile.padded,
            {distance.data(), count},
            {inverse_variance_.data(), count},
            {chunk.body_numbers.data() + first, count},
            scene.predicted.body.data() + tile.first,
            scene.points.pooled().data() + tile.first,
            static_cast<float>(scene.options.cut * chunk.spread),
            static_cast<float>(scene.options.cut),
            static_cast<float>(scene.options.visible_odds)};
  }
  std::array<const float*, kMaxCandidates> distance;  ///< to be set before candidates()

 private:
  std::array<const float*, kMaxCandidates> inverse_variance_;
};

void ModelTerm::begin(const Scene& scene, const BodyPoses& T_camera_body) {
  bodies_.resize(T_camera_body.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    PosedBody& body = bodies_[b];
    const auto& field = scene.model.fields[b];
    body.has_field = field.has_value();
    body.T_body_camera = T_camera_body[b].inverse();
    body.from_camera = to_rigid_motion(body.T_body_camera);
    body.box = OrientedBox(field ? field->bounds() : Eigen::AlignedBox3d(), T_camera_body[b]);
  }
  chunks_ = chunk_count(scene.points.tiles().size(), kTilesPerChunk);
  chunk_costs_.assign(chunks_, 0.0);
  scratch_.resize(static_cast<std::size_t>(scene.executor.threads()) + 1);
}

/// Makes room for whatever may be selected, so that nothing is allocated later.
void ModelTerm::prepare(Linearization& linearization) const {
  linearization.resize(std::max(linearization.size(), chunks_));
  const std::size_t most = kTilesPerChunk * std::min(kMaxCandidates, bodies_.size());
  for (Chunk& chunk : linearization) {
    chunk.bodies.reserve(most);
    chunk.body_numbers.reserve(most);
    chunk.inverse_variance.reserve(most * kTilePoints);
    chunk.tile_systems.reserve(most);
    chunk.sums.reserve(bodies_.size());
    if (!chunk.planes) {
      chunk.planes = std::make_unique<float[]>(kTilesPerChunk * kPlaneNumbers * kTilePoints);
    }
  }
}

/// Where a tile's points see the body, and which planes they see in place of its nearest surface.
void ModelTerm::look_up(const Scene& scene, std::size_t tile_index, std::size_t tile_of_chunk,
                        std::size_t candidate, const kernels::FieldHits& hits, Chunk& chunk) const {
  const Tile& tile = scene.points.tiles()[tile_index];
  const int body = chunk.bodies[candidate];
  const auto b = static_cast<std::size_t>(body);
  kernels::look_up(scene.model.fields[b]->view(), bodies_[b].from_camera,
                   point_noise(scene.options.noise, scene.camera, chunk.spread),
                   points_of(scene.points, tile), predicted_pixels(scene, tile),
                   static_cast<float>(body), static_cast<float>(scene.options.cut), hits,
                   chunk.planes_of(tile_of_chunk), chunk.has_planes[tile_of_chunk]);
}

void ModelTerm::select_candidates(const Scene& scene, std::size_t chunk_index, double spread,
                                  Chunk& chunk) const {
  const PointTiles& points = scene.points;
  const std::size_t first = chunk_index * kTilesPerChunk;
  const std::size_t tiles = tiles_in_chunk(points, first, kTilesPerChunk);
  Eigen::AlignedBox3f bounds;
  std::array<double, kTilesPerChunk> gates{};
  for (std::size_t k = 0; k < tiles; ++k) {
    const Tile& tile = points.tiles()[first + k];
    if (tile.count > 0) {
      bounds.extend(tile.bounds);
      gates[k] = gate_of(tile, scene.camera, scene.options, spread);
    }
  }
  const double widest = *std::max_element(gates.begin(), gates.end());
  chunk.sums.clear();  // the bodies that any of the tiles may see
  for (std::size_t b = 0; b < bodies_.size() && !bounds.isEmpty(); ++b) {
    if (bodies_[b].has_field && bodies_[b].box.may_touch(bounds, widest)) {
      chunk.sums.emplace_back(static_cast<int>(b), BodySystem{});
    }
  }
  chunk.bodies.clear();
  for (std::size_t k = 0; k < tiles; ++k) {
    chunk.first[k] = chunk.bodies.size();
    const Tile& tile = points.tiles()[first + k];
    for (const auto& [body, sum] : chunk.sums) {
      if (tile.count > 0 && chunk.bodies.size() - chunk.first[k] < kMaxCandidates &&
          bodies_[static_cast<std::size_t>(body)].box.may_touch(tile.bounds, gates[k])) {
        chunk.bodies.push_back(body);
      }
    }
  }
  std::fill(chunk.first.begin() + static_cast<std::ptrdiff_t>(tiles), chunk.first.end(),
            chunk.bodies.size());
  chunk.body_numbers.assign(chunk.bodies.begin(), chunk.bodies.end());
  chunk.inverse_variance.resize(
      std::max(chunk.inverse_variance.size(), chunk.bodies.size() * kTilePoints));
  chunk.tile_systems.resize(chunk.bodies.size());
}

double ModelTerm::linearize_chunk(const Scene& scene, std::size_t chunk_index, double spread,
                                  const Chunk* frozen, Linearization& linearization) {
  const PointTiles& points = scene.points;
  Scratch scratch(scratch_[Executor::worker()]);
  Chunk& chunk = linearization[chunk_index];
  select_candidates(scene, chunk_index, spread, chunk);
  chunk.spread = spread;
  chunk.cost = 0.0;
  chunk.totals = {};
  const std::size_t first_tile = chunk_index * kTilesPerChunk;
  double cost = 0.0;
  for (std::size_t k = 0; k < tiles_in_chunk(points, first_tile, kTilesPerChunk); ++k) {
    chunk.has_planes[k] = false;
    for (std::size_t c = chunk.first[k]; c < chunk.first[k + 1]; ++c) {
      kernels::FieldHits& hits = scratch.hits[c - chunk.first[k]];
      hits.inverse_variance = chunk.inverse_variance.data() + c * kTilePoints;
      look_up(scene, first_tile + k, k, c, hits, chunk);
    }
    if (frozen != nullptr) {
      cost += frozen_cost(scene, first_tile + k, k, *frozen, &chunk, scratch);
    }
    linearize_tile(scene, first_tile + k, k, scratch, chunk);
  }
  return cost;
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
    chunk.tile_systems[first + l] = {tile_index, body, tile.weight, system.hessian,
                                     system.gradient};
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

double ModelTerm::linearize(const Scene& scene, const BodyPoses& T_camera_body, double spread,
                            std::vector<BodySystem>& systems) {
  begin(scene, T_camera_body);
  prepare(last_);
  scene.executor.for_each(
      chunks_, [&](std::size_t chunk) { linearize_chunk(scene, chunk, spread, nullptr, last_); });
  return sum_up(systems);
}

double ModelTerm::cost(const Scene& scene, const BodyPoses& T_camera_body) {
  begin(scene, T_camera_body);
  scene.executor.for_each(chunks_, [&](std::size_t chunk) {
    Scratch scratch(scratch_[Executor::worker()]);
    const std::size_t first = chunk * kTilesPerChunk;
    for (std::size_t k = 0; k < tiles_in_chunk(scene.points, first, kTilesPerChunk); ++k) {
      chunk_costs_[chunk] += frozen_cost(scene, first + k, k, last_[chunk], nullptr, scratch);
    }
  });
  return std::accumulate(chunk_costs_.begin(), chunk_costs_.end(), 0.0);
}

double ModelTerm::cost_ahead(const Scene& scene, const BodyPoses& T_camera_body, double spread) {
  begin(scene, T_camera_body);
  prepare(ahead_);
  scene.executor.for_each(chunks_, [&](std::size_t chunk) {
    chunk_costs_[chunk] = linearize_chunk(scene, chunk, spread, &last_[chunk], ahead_);
  });
  return std::accumulate(chunk_costs_.begin(), chunk_costs_.end(), 0.0);
}

double ModelTerm::take_ahead(std::vector<BodySystem>& systems) {
  std::swap(last_, ahead_);
  return sum_up(systems);
}

/// In the order of the chunks.
double ModelTerm::sum_up(std::vector<BodySystem>& systems) {
  totals_ = {};
  double cost = 0.0;
  for (const Chunk& chunk : std::span(last_.data(), chunks_)) {
    cost += chunk.cost;
    totals_.weighted_squares += chunk.totals.weighted_squares;
    totals_.points += chunk.totals.points;
    for (const auto& [body, sum] : chunk.sums) {
      systems[static_cast<std::size_t>(body)] += sum;
    }
  }
  return cost;
}

void ModelTerm::append_tile_systems(std::vector<TileSystem>& systems) const {
  for (const Chunk& chunk : std::span(last_.data(), chunks_)) {
    systems.insert(systems.end(), chunk.tile_systems.begin(), chunk.tile_systems.end());
  }
}

}  // namespace lockbox
