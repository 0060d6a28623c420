// SPDX-License-Identifier: BSD-3-Clause
// Outlines are known to a small part of a pixel, from a view that has whole pixels only.
#include "lockbox/registration/outline_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "mechanism.hpp"

namespace lockbox {
namespace {

constexpr int kFiner = 16;  // samples a pixel and axis, of the view that knows better
const PinholeCamera kCamera{160, 120, 144.0, 144.0, 79.5, 59.5};

class OutlinePointsTest : public ::testing::Test {
 protected:
  const ArticulatedModel& model = mechanism();
  const Executor executor{2};
  BodyPoses poses;

  void SetUp() override { forward_kinematics(model.tree, mechanism_start(model), poses); }

  OutlinePoints outlines_seen_by(const PinholeCamera& camera) const {
    VisibleSurface surface;
    surface.render(model, poses, camera, camera.width, executor);
    OutlinePoints outlines;
    outlines.collect(model, surface, {}, executor);
    return outlines;
  }

  /// How far beyond the point along its normal the finer view shows the body end, pixels of the
  /// coarse one; NaN if not within a pixel and a half.
  double beyond(const OutlinePoint& point, const VisibleSurface& finer) const {
    const PinholeCamera& camera = finer.view_camera();
    const Eigen::Isometry3d& T = poses[static_cast<std::size_t>(point.body)];
    const Eigen::Vector3d p = T * point.p_body;
    const Eigen::Vector2d at = camera.project(p);
    const Eigen::Vector2d along =
        (camera.project(p + 1e-4 * T.linear() * point.normal_body) - at).normalized();
    const auto shows_body = [&](double distance) {
      const Eigen::Vector2d q = at + distance * along;
      return finer.view().id[finer.view().index(static_cast<int>(std::lround(q.x())),
                                                static_cast<int>(std::lround(q.y())))] ==
             point.body;
    };
    for (double d = -1.5 * kFiner; d < 1.5 * kFiner; d += 1.0) {
      if (shows_body(d) && !shows_body(d + 1.0)) return (d + 0.5) / kFiner;
    }
    return std::nan("");
  }
};

TEST_F(OutlinePointsTest, LieWhereAFinerViewShowsTheBodyEnd) {
  VisibleSurface finer;
  const PinholeCamera fine = refined(kCamera, kFiner);
  finer.render(model, poses, fine, fine.width, executor);
  std::vector<double> errors;
  const OutlinePoints outlines = outlines_seen_by(kCamera);
  for (std::size_t i = 0; i < outlines.bands(); ++i) {
    for (const OutlinePoint& point : outlines.band(i)) {
      const double error = beyond(point, finer);
      if (!std::isnan(error)) errors.push_back(error);
    }
  }
  ASSERT_GT(errors.size(), 200U);
  const auto count = static_cast<double>(errors.size());
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  const double rms =
      std::sqrt(std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0) / count);
  EXPECT_NEAR(mean, 0.0, 0.05);
  EXPECT_LT(rms, 0.2);  // 0.29 if they were taken to be half a pixel beside the last one
}

/// The plate's own outline: its sides add up to what a camera sees of it.
TEST_F(OutlinePointsTest, StandForTheWholeLengthOfTheOutline) {
  const auto length_seen_by = [&](const PinholeCamera& camera) {
    double pixels = 0.0;
    const OutlinePoints outlines = outlines_seen_by(camera);
    for (std::size_t i = 0; i < outlines.bands(); ++i) {
      for (const OutlinePoint& point : outlines.band(i)) {
        if (point.body == 0) pixels += point.pixels;
      }
    }
    return pixels;
  };
  const double coarse = length_seen_by(kCamera);
  const double fine = length_seen_by(refined(kCamera, 2));
  EXPECT_NEAR(fine, 2.0 * coarse, 0.1 * fine);
}

/// A block that stands on the plate ends there, but nothing farther away begins behind its foot.
TEST_F(OutlinePointsTest, AreNotWhereASideMeetsWhatItStandsOn) {
  const OutlinePoints outlines = outlines_seen_by(refined(kCamera, 4));
  for (std::size_t i = 0; i < outlines.bands(); ++i) {
    for (const OutlinePoint& point : outlines.band(i)) {
      const auto body = static_cast<std::size_t>(point.body);
      if (body == 0) continue;
      const Eigen::Vector3d p = poses[body] * point.p_body;
      const double above_plate = (poses[0].inverse() * p).z() - 0.01;
      EXPECT_GT(above_plate, 0.002) << "body " << body;
    }
  }
}

}  // namespace
}  // namespace lockbox
