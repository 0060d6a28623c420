// SPDX-License-Identifier: BSD-3-Clause
// Which planes belong to the scene, not to the object.
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/cloud/segmentation.hpp"
#include "plane_segmentation.hpp"

namespace lockbox {

/// Returns for each plane whether it reaches beyond the object: more than a quarter of its surface
/// is not near the object, or it is wider, in some direction, than the object is by more than
/// margin (metres). The object's own planes do neither, however large they are in the image; nor
/// does it matter where exactly they are, so that the front of a flat object stays when the wall 18
/// mm behind it goes. surface: of surface_planes(); near_object: one byte a sample.
std::vector<std::uint8_t> scene_planes(const SampleGrid& grid, const std::vector<Plane>& planes,
                                       const std::vector<int>& surface,
                                       const std::vector<std::uint8_t>& near_object,
                                       const std::vector<ExpectedBody>& bodies, double margin);

}  // namespace lockbox
