// SPDX-License-Identifier: BSD-3-Clause
// The free-space term at contours: both sides of them count.
#include <algorithm>
#include <span>

#include "image_tile.hpp"
#include "lockbox/terms/free_space_term.hpp"

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

/// Towards where the camera saw them.
void FreeSpaceTerm::aim_contours(const Scene& scene, const BodyPoses& T_camera_body,
                                 double annealing_sigma, std::size_t band) {
  ObservedContour& observed = observed_contours_[Executor::worker()];
  for (std::span<const ContourPoint> rest(scene.contours.band(band)); !rest.empty();) {
    const int body = rest.front().body;
    const auto end = std::find_if(rest.begin(), rest.end(),
                                  [body](const ContourPoint& p) { return p.body != body; });
    const auto own = rest.first(static_cast<std::size_t>(end - rest.begin()));
    rest = rest.subspan(own.size());
    const Eigen::Isometry3d& T = T_camera_body[static_cast<std::size_t>(body)];
    observed.look(own, T, scene.cloud, scene.options, annealing_sigma);
    append_correspondences(own, T, scene.cloud.camera(), observed, contours_.chunk(band));
  }
}

}  // namespace lockbox
