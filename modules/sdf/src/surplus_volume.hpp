// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/core/parallel.hpp"
#include "winding_tree.hpp"

namespace lockbox {

/// Returns by how much signed_volume() exceeds the volume of the solid, m^3: what lies in n shells
/// counts n times there. 0 unless the bounds of shells overlap, exact where their overlaps are
/// boxes along the axes; else sampled, to about a thousandth of the volume that the bounds share.
double surplus_volume(const TriangleMesh& mesh, const WindingTree& winding,
                      const Executor& executor);

}  // namespace lockbox
