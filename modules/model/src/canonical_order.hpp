// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rigid_bodies.hpp"

namespace lockbox {

/// Puts bodies and joints into depth-first order, siblings (and the visuals of a body) ordered by
/// what they are, so that neither the order of the file nor names have a say; names decide only
/// between siblings that are equal in everything and lie upon each other. Fills Body::mesh.
RigidBodies in_canonical_order(RigidBodies rigid);

}  // namespace lockbox
