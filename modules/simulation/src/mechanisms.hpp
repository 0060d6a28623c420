// SPDX-License-Identifier: BSD-3-Clause
// What moves on a puzzle board.
#pragma once

#include "lockbox/simulation/object_draft.hpp"
#include "range.hpp"

namespace lockbox::simulation {

enum class MechanismKind { slider, bolt, disk, door };

/// Drawn for a square cell of the board about the origin, the board's face being z = 0.
struct Mechanism {
  MechanismKind kind;
  std::vector<DraftPart> fixed;   ///< on the board
  std::vector<DraftPart> moving;  ///< in the joint's frame
  DraftJoint joint;               ///< without names
};

/// cell: edge length, metres. Parts touch each other and the board, without gaps. has_round_grips:
/// as opposed to square ones.
Mechanism draw_mechanism(MechanismKind kind, double cell, bool has_round_grips,
                         RandomDraws& random);

}  // namespace lockbox::simulation
