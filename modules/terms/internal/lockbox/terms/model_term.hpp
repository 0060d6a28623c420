// SPDX-License-Identifier: BSD-3-Clause
// E_model: every observed point under a bounded robust loss of its distance to the body that
// explains it, whitened by the sensor's noise along the field's gradient (docs/mathematics.md).
//
//   E_model(x) = sum_p rho_softmin_l( d_l(T_l^-1 p)^2 / (n' Sigma_p n + annealing_sigma^2) )
//
// Cost: one field look-up per point and candidate body, whatever the number of joints.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "lockbox/cloud/point_tiles.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/solver/normal_equations.hpp"
#include "lockbox/terms/oriented_box.hpp"
#include "lockbox/terms/term_options.hpp"
#include "lockbox/view/pixel_prediction.hpp"

namespace lockbox {

/// Owns the frozen selection of the last linearisation and all scratch memory.
class ModelTerm {
 public:
  /// What a linearisation is made from, by reference.
  struct Scene {
    const ArticulatedModel& model;
    const PointTiles& points;
    const PinholeCamera& camera;       ///< that measured them
    const PixelPrediction& predicted;  ///< of these points
    const TermOptions& options;
    const Executor& executor;
  };

  /// Selects candidates and variances at these poses, and adds each body's system to systems.
  /// annealing_sigma: how far off the poses may still be, metres. Returns the cost relative to that
  /// of explaining nothing (so it is negative). beside: what else may be done in the same loop.
  double linearize(const Scene& scene, const BodyPoses& T_camera_body, double annealing_sigma,
                   std::vector<BodySystem>& systems, const Loop& beside = {});

  /// The cost at other poses under the selection of the last linearisation.
  double cost(const Scene& scene, const BodyPoses& T_camera_body, const Loop& beside = {});

  /// The same, and on the way the linearisation there: what it takes is looked up already.
  double cost_ahead(const Scene& scene, const BodyPoses& T_camera_body, double annealing_sigma,
                    const Loop& beside = {});

  /// Makes the linearisation of cost_ahead the last one, as linearize would have done.
  double take_ahead(std::vector<BodySystem>& systems);

  /// What each tile adds to the system of each body: clusters of residuals for the covariance.
  void append_tile_systems(std::vector<TileSystem>& systems) const;

  struct Totals {
    double weighted_squares = 0.0;  ///< sum of weight * whitened residual^2
    double points = 0.0;            ///< sum of weights: points that the model explains
  };
  const Totals& totals() const { return totals_; }

 private:
  static constexpr std::size_t kTilesPerChunk = 8;  // fixed, so that sums do not depend on threads
  static constexpr std::size_t kPlaneNumbers = 4;

  struct Scratch;

  /// A body at a pose, as candidates are sought and points looked up.
  struct PosedBody {
    bool has_field;
    kernels::RigidMotion from_camera;
    Eigen::Isometry3d T_body_camera;
    OrientedBox box;
  };

  /// Consecutive tiles of the points, and the bodies that compete for their points.
  struct Chunk {
    std::array<std::size_t, kTilesPerChunk + 1> first{};  ///< candidate of each tile
    std::vector<int> bodies;                              ///< by candidate, tile by tile
    std::vector<float> body_numbers;                      ///< the same, as the kernels compare them
    std::vector<float> inverse_variance;                  ///< kTilePoints a candidate
    std::vector<TileSystem> tile_systems;                 ///< by candidate
    std::vector<std::pair<int, BodySystem>> sums;         ///< of the bodies that occur
    std::array<bool, kTilesPerChunk> has_planes{};
    std::unique_ptr<float[]> planes;  ///< kPlaneNumbers arrays of kTilePoints a tile
    double annealing_sigma = 0.0;     ///< metres
    double cost = 0.0;
    Totals totals;

    kernels::BodyPlanes planes_of(std::size_t tile_of_chunk) const;
  };
  using Linearization = std::vector<Chunk>;

  void begin(const Scene& scene, const BodyPoses& T_camera_body);
  void prepare(Linearization& linearization) const;
  void select_candidates(const Scene& scene, std::size_t chunk_index, double annealing_sigma,
                         Chunk& chunk) const;
  void look_up(const Scene& scene, std::size_t tile, std::size_t tile_of_chunk,
               std::size_t candidate, const kernels::FieldHits& hits, Chunk& chunk) const;
  static const float* nearest_of(const Chunk& chunk, std::size_t tile_of_chunk, int body,
                                 std::span<const kernels::FieldHits> hits);
  /// Of one chunk; returns its cost under a frozen selection, if there is one.
  double linearize_chunk(const Scene& scene, std::size_t chunk_index, double annealing_sigma,
                         const Chunk* frozen, Linearization& linearization);
  void linearize_tile(const Scene& scene, std::size_t tile, std::size_t tile_of_chunk,
                      Scratch& scratch, Chunk& chunk) const;
  /// current: whose look-ups the scratch memory holds, if any.
  double frozen_cost(const Scene& scene, std::size_t tile, std::size_t tile_of_chunk,
                     const Chunk& frozen, const Chunk* current, Scratch& scratch) const;
  double sum_up(std::vector<BodySystem>& systems);

  std::vector<PosedBody> bodies_;  ///< at the poses in hand
  std::size_t chunks_ = 0;         ///< of the points in hand; there may have been more before
  Linearization last_;
  Linearization ahead_;
  std::vector<double> chunk_costs_;          ///< under the frozen selection
  std::vector<std::vector<float>> scratch_;  ///< one block of memory a worker
  Totals totals_;
};

}  // namespace lockbox
