// SPDX-License-Identifier: BSD-3-Clause
// E_collision: bodies that penetrate each other after both were eroded by epsilon.
//
//   E = sum over pairs (A, B) of mean over A's eroded surface of (min(0, f_B + eps) / sigma_c)^2 /
//   2
//       + the same with A and B exchanged
//
// A's eroded surface is its level set f_A = -eps. Flush contact costs nothing; overlap beyond
// 2 eps does. Bodies only feel the joints on the path between them (docs/mathematics.md).
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/solver/normal_equations.hpp"
#include "lockbox/terms/clear_way.hpp"
#include "lockbox/terms/eroded_surface.hpp"
#include "lockbox/terms/term_options.hpp"

namespace lockbox {

/// Two bodies that joints can move against each other.
struct CollisionPair {
  int a = 0;
  int b = 0;
  double erosion = 0.0;       ///< metres, half the rest overlap included
  double rest_overlap = 0.0;  ///< metres, deepest penetration in the rest configuration, if any
};

/// Constant data: pairs and the samples of eroded surfaces. Between calls it remembers the last
/// result, and how far bodies may move before they can touch; that changes no result.
class CollisionTerm {
 public:
  /// Measures the overlaps of the rest configuration and samples the eroded surfaces. Throws
  /// InputError naming the links if an erosion of the model's file exceeds an eighth of the thinner
  /// body's thickness: its eroded surface would vanish.
  CollisionTerm(const ArticulatedModel& model, const CollisionOptions& options,
                const Executor& executor = Executor(1));

  const std::vector<CollisionPair>& pairs() const { return pairs_; }

  /// Adds lambda times the term to the equations, and returns lambda times its cost.
  double linearize(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                   NormalEquations& equations);

  /// lambda times the cost.
  double cost(const ArticulatedModel& model, const BodyPoses& T_camera_body);

  /// lambda times the cost of the pairs of which one body is marked and the other is not, by body:
  /// what a joint that moves the marked ones can change.
  double cost_between(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                      const std::vector<std::uint8_t>& moved);

  /// Both for who has a loop to share: how many parts there are, none where the term was evaluated
  /// last; each of them, by any thread; and what they sum up to, added to the equations if given.
  std::size_t begin(const BodyPoses& T_camera_body);
  void evaluate_part(const ArticulatedModel& model, const BodyPoses& T_camera_body, std::size_t i);
  double sum_up(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                NormalEquations* equations);

 private:
  void evaluate(const ArticulatedModel& model, const BodyPoses& T_camera_body);

  /// Of a pair, one body's samples in the other's field.
  struct Half {
    double cost = 0.0;
    BodySystem system;
    std::vector<ClearWay> clear_ways;  ///< by group of the surface
  };

  struct Erosion {
    int body;
    double depth;  ///< metres
    bool operator==(const Erosion&) const = default;
  };

  std::vector<Erosion> list_erosions();
  bool stands_at(const BodyPoses& T_camera_body) const;
  void compare(const ArticulatedModel& model, const ErodedSurface& surface, int other,
               double erosion, const Eigen::Isometry3d& T_other_body, Half& half);
  void add_sample(const SignedDistanceField& field, const Eigen::AlignedBox3f& box,
                  const Eigen::Isometry3f& T_other_body, const ErodedSurface::Sample& sample,
                  float erosion, Half& half) const;

  Executor executor_;
  double weight_ = 0.0;  ///< lambda / sigma_c^2
  std::vector<CollisionPair> pairs_;
  std::vector<std::pair<std::size_t, std::size_t>> pair_surfaces_;  ///< of a and of b
  std::vector<ErodedSurface> surfaces_;
  BodyPoses evaluated_;       ///< what the halves are of
  std::vector<Half> halves_;  ///< two a pair
  std::vector<std::size_t> between_;
  BodyJacobian jacobian_;
};

}  // namespace lockbox
