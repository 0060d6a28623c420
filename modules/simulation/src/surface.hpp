// SPDX-License-Identifier: BSD-3-Clause
// What the neighbourhood of a sample tells about the surface there.
#pragma once

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox::simulation {

/// Depth of the sample, or of the nearest one in the image; metres.
float depth_at(const RenderedDepth& image, int u, int v);

/// Cosine of the angle between the ray of sample (u, v) and the surface's normal; depth(u, v) must
/// be finite. At an edge the surface is taken to go on as it does on the side away from the edge.
float cosine_of_incidence(const RenderedDepth& image, const PinholeCamera& camera, int u, int v);

/// Whether the disparity of the sample differs by more than 1 from that of one of its four
/// neighbours, `distance` samples away. unit_disparity_depth: where the disparity is 1, metres.
bool beside_jump(const RenderedDepth& image, int u, int v, int distance,
                 float unit_disparity_depth);

}  // namespace lockbox::simulation
