// SPDX-License-Identifier: BSD-3-Clause
#include "contour_correspondences.hpp"

#include <algorithm>

#include "image_tile.hpp"
#include "lockbox/solver/normal_equations.hpp"

namespace lockbox {
namespace {

/// Correspondences of contour points of one body to where the camera saw them.
void append_correspondences(std::span<const ContourPoint> points,
                            const Eigen::Isometry3d& T_camera_body, const PinholeCamera& camera,
                            const ObservedContour& observed,
                            std::vector<FreeSpaceCorrespondence>& correspondences) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!observed.is_seen(k)) continue;
    const ContourPoint& point = points[k];
    const Eigen::Vector3d expected = T_camera_body * point.p_body;
    const auto pixel = camera.pixel_of(expected);
    if (!pixel) continue;
    const Eigen::Vector3d normal = T_camera_body.linear() * point.normal_body;
    const Eigen::Vector3d target = expected + observed.offset_of(k) * normal;
    correspondences.push_back(
        {point.p_body.cast<float>(), target.cast<float>(), normal.cast<float>(),
         static_cast<float>(observed.variance_of(k)), static_cast<float>(kNormalVariance),
         static_cast<float>(point.pixels), point.body, tile_of(*pixel, camera)});
  }
}

}  // namespace

void append_contour_correspondences(std::span<const ContourPoint> points,
                                    const BodyPoses& T_camera_body, const TiledCloud& cloud,
                                    const TermOptions& options, double annealing_sigma,
                                    ObservedContour& observed,
                                    std::vector<FreeSpaceCorrespondence>& correspondences) {
  while (!points.empty()) {
    const int body = points.front().body;
    const auto end = std::find_if(points.begin(), points.end(),
                                  [body](const ContourPoint& p) { return p.body != body; });
    const auto own = points.first(static_cast<std::size_t>(end - points.begin()));
    points = points.subspan(own.size());
    const Eigen::Isometry3d& T = T_camera_body[static_cast<std::size_t>(body)];
    observed.look(own, T, cloud, options, annealing_sigma);
    append_correspondences(own, T, cloud.camera(), observed, correspondences);
  }
}

}  // namespace lockbox
