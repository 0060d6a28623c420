// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "lockbox/mesh/triangle_mesh.hpp"
#include "lockbox/sdf/signed_distance_field.hpp"

namespace lockbox {

/// The surface of a body in as few triangles as show it, but not fewer than about `fewest`: their
/// corners and middles lie within most_off of it, metres, by the field. Of many triangles most are
/// smaller than a pixel.
TriangleMesh drawn_mesh(const TriangleMesh& mesh, const SignedDistanceField& field,
                        std::size_t fewest, double most_off);

}  // namespace lockbox
