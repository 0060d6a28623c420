// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/view_detail.hpp"

#include <algorithm>

namespace lockbox {
namespace {

constexpr int kFewestColumns = 160;           // columns
constexpr int kMostColumns = 640;             // the same: one ray a pixel for common sensors
constexpr std::size_t kEnoughPoints = 20000;  // more tell where they are, but nothing of the view
/// Rays of the view for each point of the budget. Source: not recorded. Doubled, views take up to
/// four times as long to draw, as columns are doubled.
constexpr std::size_t kRaysToPoints = 2;
/// With fewer points, which can only be asked for the sake of time, edges are compared only where
/// they tell most about joints, and contours are looked at at every other pixel.
constexpr std::size_t kForAllEdges = 2000;
constexpr std::size_t kPatchesPerJoint = 30;
/// With fewer, not at all, and contours are looked at at every fourth pixel.
constexpr std::size_t kForEdges = 1000;

/// Pixels of the rectangle around all that the image may show of the model.
double pixels_around(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                     const PinholeCamera& camera) {
  const Eigen::AlignedBox2d image(Eigen::Vector2d::Zero(),
                                  Eigen::Vector2d(camera.width, camera.height));
  Eigen::AlignedBox2d around;
  for (std::size_t b = 0; b < model.fields.size(); ++b) {
    if (!model.fields[b]) continue;
    const Eigen::AlignedBox3d& box = model.fields[b]->bounds();
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d p =
          T_camera_body[b] * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
      if (p.z() <= 0.0) return image.volume();
      around.extend(camera.project(p));
    }
  }
  const Eigen::AlignedBox2d seen = around.intersection(image);
  return seen.isEmpty() ? 0.0 : seen.volume();
}

}  // namespace

ViewDetail view_detail(std::size_t point_budget) {
  const std::size_t points =
      point_budget > 0 ? std::min(point_budget, kEnoughPoints) : kEnoughPoints;
  const std::size_t rays = kRaysToPoints * points;
  if (points < kForEdges) return {rays, 4, 0};
  if (points < kForAllEdges) return {rays, 2, kPatchesPerJoint};
  return {rays, 1, kAllPatches};
}

int view_columns(std::size_t rays, const ArticulatedModel& model, const BodyPoses& T_camera_body,
                 const PinholeCamera& camera) {
  const double pixels = pixels_around(model, T_camera_body, camera);
  const auto wanted = static_cast<double>(rays);
  const auto rays_of = [&](int columns) {
    const double share = static_cast<double>(columns) / camera.width;
    return pixels * share * share;
  };
  int columns = kFewestColumns;
  while (columns < kMostColumns && rays_of(columns) < wanted) columns *= 2;
  return columns;
}

}  // namespace lockbox
