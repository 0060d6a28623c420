// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "outer_surface.hpp"

namespace lockbox {

/// The thinnest wall, metres: the way through the solid along the inward normal, fifth percentile
/// over each shell's exposed surface, the least of all shells. A thin knob on a large board counts.
double thinnest_wall(const OuterSurface& surface, const TriangleTree& tree,
                     const TriangleMesh& mesh, const WindingTree& winding,
                     const Executor& executor);

}  // namespace lockbox
