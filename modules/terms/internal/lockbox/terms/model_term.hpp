// SPDX-License-Identifier: BSD-3-Clause
// E_model: every observed point under a bounded robust loss of its distance to the body that
// explains it, whitened by the sensor's noise along the field's gradient (docs/mathematics.md).
//
//   E_model(x) = sum_p rho_softmin_l( d_l(T_l^-1 p)^2 / (n' Sigma_p n + annealing_sigma^2) )
//
// Cost: one field look-up per point and candidate body, whatever the number of joints.
#pragma once

#include <cstddef>
#include <vector>

#include "lockbox/cloud/point_tiles.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/solver/normal_equations.hpp"
#include "lockbox/terms/model_term_chunk.hpp"
#include "lockbox/terms/term_options.hpp"
#include "lockbox/view/pixel_prediction.hpp"

namespace lockbox {

/// Owns the frozen selection of the last linearisation, and memory that is used again. It is for
/// one thread at a time: costs, which change nothing that is seen, use that memory, too.
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
  double cost(const Scene& scene, const BodyPoses& T_camera_body, const Loop& beside = {}) const;

  /// The same, and on the way the linearisation there: what it takes is looked up already.
  double cost_ahead(const Scene& scene, const BodyPoses& T_camera_body, double annealing_sigma,
                    const Loop& beside = {});

  /// Makes the linearisation of cost_ahead the last one, as linearize would have done.
  double take_ahead(std::vector<BodySystem>& systems);

  /// What each tile adds to the system of each body: clusters of residuals for the covariance.
  void append_tile_systems(std::vector<TileSystem>& systems) const;

  using Totals = ModelTermTotals;
  const Totals& totals() const { return totals_; }

 private:
  using Chunk = ModelTermChunk;
  using Linearization = std::vector<Chunk>;

  void begin(const Scene& scene, const BodyPoses& T_camera_body) const;
  void prepare(Linearization& linearization) const;
  void select_candidates(const Scene& scene, std::size_t chunk_index, double annealing_sigma,
                         Chunk& chunk) const;
  /// Linearizes one chunk; returns its cost under a frozen selection, if there is one.
  double linearize_chunk(const Scene& scene, std::size_t chunk_index, double annealing_sigma,
                         const Chunk* frozen, Linearization& linearization) const;
  double sum_up(std::vector<BodySystem>& systems);

  std::size_t chunks_ = 0;  ///< of the last linearisation; there may have been more before
  Linearization last_;
  Linearization ahead_;
  Totals totals_;
  // Memory, which each call fills before it reads it.
  mutable std::vector<PosedBody> bodies_;            ///< at the poses in hand
  mutable std::vector<double> chunk_costs_;          ///< under the frozen selection
  mutable std::vector<std::vector<float>> scratch_;  ///< one block a worker
};

}  // namespace lockbox
