// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/model_term.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lockbox/kernels/point_to_field.hpp"
#include "rigid_motion.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kTilesPerChunk = 16;  // fixed, so that sums do not depend on threads
constexpr std::size_t kMaxCandidates = 16;  // bodies that may compete for the points of a tile
constexpr std::size_t kArraysPerCandidate = 8;

kernels::RigidMotion body_from_camera(const Eigen::Isometry3d& T_camera_body) {
  return to_rigid_motion(T_camera_body.inverse());
}

kernels::PointSpan points_of(const TiledCloud& cloud, const Tile& tile) {
  return {cloud.x().data() + tile.first, cloud.y().data() + tile.first,
          cloud.z().data() + tile.first, tile.padded};
}

/// Whether a box in the camera's frame comes within gate of a box in the body's frame: separating
/// axes of both boxes' faces, so it may say yes too often but never no wrongly.
bool may_touch(const Eigen::AlignedBox3f& tile, const Eigen::AlignedBox3d& body,
               const Eigen::Isometry3d& T_camera_body, double gate) {
  const Eigen::Vector3d tile_center = tile.center().cast<double>();
  const Eigen::Vector3d tile_half = 0.5 * tile.sizes().cast<double>();
  const Eigen::Vector3d body_half = (0.5 * body.sizes()).array() + gate;
  const Eigen::Matrix3d& R = T_camera_body.linear();
  const Eigen::Matrix3d R_abs = R.cwiseAbs();
  const Eigen::Vector3d offset_camera = tile_center - T_camera_body * body.center();
  const Eigen::Vector3d offset_body = R.transpose() * offset_camera;
  return (offset_camera.cwiseAbs().array() <= (tile_half + R_abs * body_half).array()).all() &&
         (offset_body.cwiseAbs().array() <= (body_half + R_abs.transpose() * tile_half).array())
             .all();
}

BodySystem to_system(const kernels::NormalSums& sums) {
  BodySystem system;
  int k = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      system.hessian(row, column) = system.hessian(column, row) = sums.hessian[k++];
    }
    system.gradient[row] = sums.gradient[row];
  }
  return system;
}

}  // namespace

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
      hits[l] = {take(), {take(), take(), take()}, {take(), take(), take()}, nullptr};
      distance[l] = hits[l].distance;
      weight[l] = take();
    }
  }

  std::array<kernels::FieldHits, kMaxCandidates> hits;
  std::array<const float*, kMaxCandidates> distance;
  std::array<const float*, kMaxCandidates> inverse_variance;
  std::array<float*, kMaxCandidates> weight;
};

void ModelTerm::select_candidates(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                                  const TiledCloud& cloud, const RegistrationOptions& options,
                                  double spread) {
  tiles_.clear();
  candidates_.clear();
  for (std::size_t t = 0; t < cloud.tiles().size(); ++t) {
    const Tile& tile = cloud.tiles()[t];
    if (tile.count == 0) {
      continue;
    }
    const double depth = static_cast<double>(tile.bounds.max().z());
    const double sigma =
        std::max(options.noise.depth_floor + options.noise.depth_quadratic * depth * depth,
                 options.noise.lateral_pixels / cloud.camera().fx * depth);
    const double gate = options.cut * std::hypot(sigma, spread);
    const std::size_t first = candidates_.size();
    for (std::size_t b = 0; b < model.fields.size(); ++b) {
      if (model.fields[b] && candidates_.size() - first < kMaxCandidates &&
          may_touch(tile.bounds, model.fields[b]->bounds(), T_camera_body[b], gate)) {
        candidates_.push_back(static_cast<int>(b));
      }
    }
    if (candidates_.size() > first) {
      tiles_.push_back({t, first, candidates_.size() - first});
    }
  }
  body_numbers_.assign(candidates_.begin(), candidates_.end());
  inverse_variance_.resize(candidates_.size() * kTilePoints);
  tile_systems_.resize(candidates_.size());
}

kernels::Candidates ModelTerm::candidates_of(const TileCandidates& tile, const TiledCloud& cloud,
                                             const std::vector<float>& visible,
                                             const Scratch& scratch) const {
  const Tile& points = cloud.tiles()[tile.tile];
  return {points.padded,
          {scratch.distance.data(), tile.count},
          {scratch.inverse_variance.data(), tile.count},
          {body_numbers_.data() + tile.first, tile.count},
          visible.data() + points.first,
          cut_,
          visible_odds_};
}

double ModelTerm::linearize(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                            const TiledCloud& cloud, const std::vector<float>& visible,
                            const RegistrationOptions& options, double spread,
                            const Executor& executor, std::vector<BodySystem>& systems) {
  cut_ = static_cast<float>(options.cut);
  visible_odds_ = static_cast<float>(options.visible_odds);
  select_candidates(model, T_camera_body, cloud, options, spread);
  explained_.assign(cloud.x().size(), 0.0F);
  const kernels::PointNoise noise{
      static_cast<float>(options.noise.depth_floor),
      static_cast<float>(options.noise.depth_quadratic),
      static_cast<float>(options.noise.lateral_pixels / cloud.camera().fx),
      static_cast<float>(spread)};
  const std::size_t chunks = chunk_count(tiles_.size(), kTilesPerChunk);
  chunk_costs_.assign(chunks, 0.0);
  chunk_totals_.assign(chunks, {});
  chunk_systems_.resize(std::max(chunk_systems_.size(), chunks));
  scratch_.resize(static_cast<std::size_t>(executor.threads()) + 1);

  const auto linearize_chunk = [&](std::size_t begin, std::size_t end, std::size_t chunk) {
    Scratch scratch(scratch_[Executor::worker()]);
    std::vector<BodySystem>& sums = chunk_systems_[chunk];
    sums.assign(model.fields.size(), BodySystem{});
    for (std::size_t k = begin; k < end; ++k) {
      const TileCandidates& candidates = tiles_[k];
      const Tile& tile = cloud.tiles()[candidates.tile];
      for (std::size_t l = 0; l < candidates.count; ++l) {
        const auto body = static_cast<std::size_t>(candidates_[candidates.first + l]);
        scratch.hits[l].inverse_variance =
            inverse_variance_.data() + (candidates.first + l) * kTilePoints;
        scratch.inverse_variance[l] = scratch.hits[l].inverse_variance;
        kernels::look_up(model.fields[body]->view(), body_from_camera(T_camera_body[body]), noise,
                         points_of(cloud, tile), scratch.hits[l]);
      }
      chunk_costs_[chunk] += kernels::associate(candidates_of(candidates, cloud, visible, scratch),
                                                {scratch.weight.data(), candidates.count},
                                                explained_.data() + tile.first);
      for (std::size_t l = 0; l < candidates.count; ++l) {
        const int body = candidates_[candidates.first + l];
        const kernels::NormalSums tile_sums =
            kernels::accumulate(tile.padded, scratch.hits[l], scratch.weight[l]);
        BodySystem system = to_system(tile_sums);
        system.add_feigned(T_camera_body[static_cast<std::size_t>(body)].inverse() *
                               tile.bounds.center().cast<double>(),
                           system.hessian.topLeftCorner<3, 3>().trace(), kNormalVariance);
        sums[static_cast<std::size_t>(body)] += system;
        tile_systems_[candidates.first + l] = {candidates.tile, body, system.hessian,
                                               system.gradient};
        chunk_totals_[chunk].weighted_squares += tile_sums.weighted_squares;
        chunk_totals_[chunk].points += tile_sums.weight;
      }
    }
  };
  executor.for_each_chunk(tiles_.size(), kTilesPerChunk, linearize_chunk);

  totals_ = {};
  double cost = 0.0;
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    cost += chunk_costs_[chunk];
    totals_.weighted_squares += chunk_totals_[chunk].weighted_squares;
    totals_.points += chunk_totals_[chunk].points;
    for (std::size_t b = 0; b < systems.size(); ++b) {
      systems[b] += chunk_systems_[chunk][b];
    }
  }
  return cost;
}

double ModelTerm::cost(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                       const TiledCloud& cloud, const std::vector<float>& visible,
                       const Executor& executor) {
  std::fill(chunk_costs_.begin(), chunk_costs_.end(), 0.0);
  executor.for_each_chunk(
      tiles_.size(), kTilesPerChunk, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        Scratch scratch(scratch_[Executor::worker()]);
        for (std::size_t k = begin; k < end; ++k) {
          const TileCandidates& candidates = tiles_[k];
          const Tile& tile = cloud.tiles()[candidates.tile];
          for (std::size_t l = 0; l < candidates.count; ++l) {
            const auto body = static_cast<std::size_t>(candidates_[candidates.first + l]);
            scratch.inverse_variance[l] =
                inverse_variance_.data() + (candidates.first + l) * kTilePoints;
            kernels::look_up_distance(model.fields[body]->view(),
                                      body_from_camera(T_camera_body[body]), points_of(cloud, tile),
                                      scratch.hits[l].distance);
          }
          chunk_costs_[chunk] +=
              kernels::association_cost(candidates_of(candidates, cloud, visible, scratch));
        }
      });
  return std::accumulate(chunk_costs_.begin(), chunk_costs_.end(), 0.0);
}

}  // namespace lockbox
