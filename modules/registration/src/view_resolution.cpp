// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/view_resolution.hpp"

#include <algorithm>
#include <array>

namespace lockbox {
namespace {

struct Step {
  std::size_t least_budget;
  ViewResolution resolution;
};
constexpr int kFinest = 640;  // columns: one ray a pixel for common sensors
constexpr std::array<Step, 2> kSteps{{{4000, {320, 1, true}}, {0, {160, 4, false}}}};
constexpr std::size_t kEnoughPoints = 20000;  // more tell where they are, but nothing of the view
constexpr double kRaysToPoints = 2.0;

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

ViewResolution view_resolution(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                               const PinholeCamera& camera, std::size_t point_budget) {
  const std::size_t points =
      point_budget > 0 ? std::min(point_budget, kEnoughPoints) : kEnoughPoints;
  ViewResolution chosen = std::find_if(kSteps.begin(), kSteps.end(), [=](const Step& step) {
                            return points >= step.least_budget;
                          })->resolution;
  const double pixels = pixels_around(model, T_camera_body, camera);
  const double wanted = kRaysToPoints * static_cast<double>(points);
  const auto rays = [&](int columns) {
    const double share = static_cast<double>(columns) / camera.width;
    return pixels * share * share;
  };
  while (chosen.columns < kFinest && rays(chosen.columns) < wanted) chosen.columns *= 2;
  return chosen;
}

}  // namespace lockbox
