// SPDX-License-Identifier: BSD-3-Clause
// Where the camera saw the contours of the model: both sides of them count.
#pragma once

#include <span>
#include <vector>

#include "lockbox/terms/correspondence_set.hpp"
#include "lockbox/terms/observed_contour.hpp"
#include "lockbox/terms/term_options.hpp"
#include "lockbox/view/contour_points.hpp"

namespace lockbox {

/// Appends a correspondence for each contour point that the image shows. points: those of one body
/// after the other. annealing_sigma: metres that the poses may be off. observed: scratch memory.
void append_contour_correspondences(std::span<const ContourPoint> points,
                                    const BodyPoses& T_camera_body, const TiledCloud& cloud,
                                    const TermOptions& options, double annealing_sigma,
                                    ObservedContour& observed,
                                    std::vector<FreeSpaceCorrespondence>& correspondences);

}  // namespace lockbox
