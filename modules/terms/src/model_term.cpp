// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/model_term.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "lockbox/sdf/rigid_motion.hpp"
#include "model_tile.hpp"
#include "model_tile_scratch.hpp"

namespace lockbox {
namespace {

/// How far from a body, metres, the points of a tile may lie to be its own.
double gate_of(const Tile& tile, const PinholeCamera& camera, const TermOptions& options,
               double annealing_sigma) {
  const double depth = static_cast<double>(tile.bounds.max().z());
  const double sigma =
      std::max(options.noise.sigma_z(depth), options.noise.sigma_lateral(depth, camera.fx));
  return options.gate * std::hypot(sigma, annealing_sigma);
}

std::size_t tiles_in_chunk(const PointTiles& points, std::size_t first, std::size_t most) {
  return std::min(most, points.tiles().size() - first);
}

}  // namespace

void ModelTerm::begin(const Scene& scene, const BodyPoses& T_camera_body) const {
  bodies_.resize(T_camera_body.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    PosedBody& body = bodies_[b];
    const auto& field = scene.model.fields[b];
    body.has_field = field.has_value();
    body.T_body_camera = T_camera_body[b].inverse();
    body.from_camera = to_rigid_motion(body.T_body_camera);
    body.box = OrientedBox(field ? field->bounds() : Eigen::AlignedBox3d(), T_camera_body[b]);
  }
  chunk_costs_.assign(chunk_count(scene.points.tiles().size(), Chunk::kTiles), 0.0);
  scratch_.resize(static_cast<std::size_t>(scene.executor.threads()) + 1);
}

/// Makes room for whatever may be selected, so that nothing is allocated later.
void ModelTerm::prepare(Linearization& linearization) const {
  linearization.resize(std::max(linearization.size(), chunk_costs_.size()));
  const std::size_t most =
      Chunk::kTiles * std::min(ModelTileScratch::kMaxCandidates, bodies_.size());
  for (Chunk& chunk : linearization) {
    chunk.bodies.reserve(most);
    chunk.body_numbers.reserve(most);
    chunk.inverse_variance.reserve(most * kTilePoints);
    chunk.tile_systems.reserve(most);
    chunk.sums.reserve(bodies_.size());
    if (!chunk.planes) {
      chunk.planes = std::make_unique<float[]>(Chunk::kTiles * Chunk::kPlaneNumbers * kTilePoints);
    }
  }
}

void ModelTerm::select_candidates(const Scene& scene, std::size_t chunk_index,
                                  double annealing_sigma, Chunk& chunk) const {
  const PointTiles& points = scene.points;
  const std::size_t first = chunk_index * Chunk::kTiles;
  const std::size_t tiles = tiles_in_chunk(points, first, Chunk::kTiles);
  Eigen::AlignedBox3f bounds;
  std::array<double, Chunk::kTiles> gates{};
  for (std::size_t k = 0; k < tiles; ++k) {
    const Tile& tile = points.tiles()[first + k];
    if (tile.count > 0) {
      bounds.extend(tile.bounds);
      gates[k] = gate_of(tile, scene.camera, scene.options, annealing_sigma);
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
      if (tile.count > 0 &&
          chunk.bodies.size() - chunk.first[k] < ModelTileScratch::kMaxCandidates &&
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

double ModelTerm::linearize_chunk(const Scene& scene, std::size_t chunk_index,
                                  double annealing_sigma, const Chunk* frozen,
                                  Linearization& linearization) const {
  const PointTiles& points = scene.points;
  ModelTileScratch scratch(scratch_[Executor::worker()]);
  Chunk& chunk = linearization[chunk_index];
  select_candidates(scene, chunk_index, annealing_sigma, chunk);
  chunk.annealing_sigma = annealing_sigma;
  chunk.cost = 0.0;
  chunk.totals = {};
  const std::size_t first_tile = chunk_index * Chunk::kTiles;
  double cost = 0.0;
  for (std::size_t k = 0; k < tiles_in_chunk(points, first_tile, Chunk::kTiles); ++k) {
    const ModelTile tile(scene, bodies_, first_tile + k, k);
    tile.look_up(scratch, chunk);
    if (frozen != nullptr) cost += tile.frozen_cost(*frozen, &chunk, scratch);
    tile.linearize(scratch, chunk);
  }
  return cost;
}

double ModelTerm::linearize(const Scene& scene, const BodyPoses& T_camera_body,
                            double annealing_sigma, std::vector<BodySystem>& systems,
                            const Loop& beside) {
  begin(scene, T_camera_body);
  chunks_ = chunk_costs_.size();
  prepare(last_);
  const auto linearize_one = [&](std::size_t chunk) {
    linearize_chunk(scene, chunk, annealing_sigma, nullptr, last_);
  };
  scene.executor.for_each({{chunks_, linearize_one}, beside});
  return sum_up(systems);
}

double ModelTerm::cost(const Scene& scene, const BodyPoses& T_camera_body,
                       const Loop& beside) const {
  begin(scene, T_camera_body);
  const auto cost_of_one = [&](std::size_t chunk) {
    ModelTileScratch scratch(scratch_[Executor::worker()]);
    const std::size_t first = chunk * Chunk::kTiles;
    for (std::size_t k = 0; k < tiles_in_chunk(scene.points, first, Chunk::kTiles); ++k) {
      const ModelTile tile(scene, bodies_, first + k, k);
      chunk_costs_[chunk] += tile.frozen_cost(last_[chunk], nullptr, scratch);
    }
  };
  scene.executor.for_each({{chunk_costs_.size(), cost_of_one}, beside});
  return std::accumulate(chunk_costs_.begin(), chunk_costs_.end(), 0.0);
}

double ModelTerm::cost_ahead(const Scene& scene, const BodyPoses& T_camera_body,
                             double annealing_sigma, const Loop& beside) {
  begin(scene, T_camera_body);
  prepare(ahead_);
  const auto linearize_one = [&](std::size_t chunk) {
    chunk_costs_[chunk] = linearize_chunk(scene, chunk, annealing_sigma, &last_[chunk], ahead_);
  };
  scene.executor.for_each({{chunk_costs_.size(), linearize_one}, beside});
  return std::accumulate(chunk_costs_.begin(), chunk_costs_.end(), 0.0);
}

double ModelTerm::take_ahead(std::vector<BodySystem>& systems) {
  std::swap(last_, ahead_);
  return sum_up(systems);
}

/// Sums up in the order of the chunks.
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
