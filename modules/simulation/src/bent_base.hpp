// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox::simulation {

/// Returns the same surface of triangles whose edges are no longer than that, metres; nothing
/// opens.
TriangleMesh with_short_edges(TriangleMesh mesh, double longest);

/// Bows the base across its thinnest extent, along its longest one: its middle moves by `bow`
/// (metres) against its ends. Joints on the base go along. Its mesh should have short edges.
void bend_base(KinematicTree& tree, double bow);

}  // namespace lockbox::simulation
