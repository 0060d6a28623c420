// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/terms/collision_term.hpp"

namespace lockbox {

/// Finds parts that stand within each other, and where they would not.
class OverlapFinder {
 public:
  OverlapFinder(const ArticulatedModel& model, const CollisionTerm& collision);

  /// Whether parts overlap by more than contact and the noise of joints explain.
  bool overlaps(const Configuration& configuration);

  /// The configuration with that variable where in its range least overlaps, the nearest such
  /// position; unchanged if no position is much better.
  Configuration with_moved(const Configuration& configuration, int variable);

 private:
  double cost(const Configuration& configuration);

  const ArticulatedModel& model_;
  CollisionTerm collision_;  ///< of its own: it remembers where bodies were
  BodyPoses poses_;
};

}  // namespace lockbox
