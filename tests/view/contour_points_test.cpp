// SPDX-License-Identifier: BSD-3-Clause
// Contours are known to a small part of a pixel, from a view that has whole pixels only.
#include "lockbox/view/contour_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "lockbox/mesh/primitives.hpp"
#include "lockbox/sdf/build_field.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

constexpr int kFiner = 16;  // samples a pixel and axis, of the view that knows better
const PinholeCamera kCamera{160, 120, 144.0, 144.0, 79.5, 59.5};

ContourPoints contours_of(const ArticulatedModel& model, const VisibleSurface& surface, int spacing,
                          const Executor& executor) {
  ViewEdges edges;
  edges.find(surface.view(), executor);
  const ContinuedEdges none;
  ContourPoints contours;
  contours.begin(surface.view());
  executor.for_each(contours.bands(), [&](std::size_t i) {
    contours.find_band({model, surface, edges, none, spacing, {}}, i);
  });
  return contours;
}

class ContourPointsTest : public ::testing::Test {
 protected:
  const ArticulatedModel& model = mechanism();
  const Executor executor{2};
  BodyPoses poses;

  void SetUp() override { forward_kinematics(model.tree, mechanism_start(model), poses); }

  ContourPoints contours_seen_by(const PinholeCamera& camera) const {
    return contours_seen_by(camera, camera.width, 1);
  }
  ContourPoints contours_seen_by(const PinholeCamera& camera, int columns, int spacing) const {
    VisibleSurface surface;
    surface.render(model, poses, camera, columns, executor);
    return contours_of(model, surface, spacing, executor);
  }

  /// Pixels of the camera along the contours of a body, and how many points they are made of.
  static std::pair<double, int> length_of(const ContourPoints& contours, int body) {
    double pixels = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < contours.bands(); ++i) {
      for (const ContourPoint& point : contours.band(i)) {
        if (point.body != body) continue;
        pixels += point.pixels;
        ++count;
      }
    }
    return {pixels, count};
  }

  /// How far beyond the point along its normal the finer view shows the body end, pixels of the
  /// coarse one; NaN if not within a pixel and a half.
  double beyond(const ContourPoint& point, const VisibleSurface& finer) const {
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

TEST_F(ContourPointsTest, LieWhereAFinerViewShowsTheBodyEnd) {
  VisibleSurface finer;
  const PinholeCamera fine = refined(kCamera, kFiner);
  finer.render(model, poses, fine, fine.width, executor);
  std::vector<double> errors;
  const ContourPoints contours = contours_seen_by(kCamera);
  for (std::size_t i = 0; i < contours.bands(); ++i) {
    for (const ContourPoint& point : contours.band(i)) {
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

/// The plate's own contour: its sides add up to what a camera sees of it.
TEST_F(ContourPointsTest, StandForTheWholeLengthOfTheContour) {
  const double coarse = length_of(contours_seen_by(kCamera), 0).first;
  const double fine = length_of(contours_seen_by(refined(kCamera, 2)), 0).first;
  EXPECT_NEAR(fine, 2.0 * coarse, 0.1 * fine);
}

/// A view of fewer pixels has as many points of the contour as it is asked for.
TEST_F(ContourPointsTest, StandForTheSameLengthInAViewOfFewerPixels) {
  const PinholeCamera camera = refined(kCamera, 4);
  const auto [length, count] = length_of(contours_seen_by(camera), 0);
  for (const int reduction : {2, 4}) {
    for (const int spacing : {1, 4}) {
      const auto [own_length, own_count] =
          length_of(contours_seen_by(camera, camera.width / reduction, spacing), 0);
      EXPECT_NEAR(own_length, length, 0.1 * length) << reduction << ", " << spacing;
      const double expected = 1.0 * count / std::min(spacing, reduction);
      EXPECT_NEAR(own_count, expected, 0.1 * expected) << reduction << ", " << spacing;
    }
  }
}

/// A block that stands on the plate ends there, but nothing farther away begins behind its foot.
TEST_F(ContourPointsTest, AreNotWhereASideMeetsWhatItStandsOn) {
  const ContourPoints contours = contours_seen_by(refined(kCamera, 4));
  for (std::size_t i = 0; i < contours.bands(); ++i) {
    for (const ContourPoint& point : contours.band(i)) {
      const auto body = static_cast<std::size_t>(point.body);
      if (body == 0) continue;
      const Eigen::Vector3d p = poses[body] * point.p_body;
      const double above_plate = (poses[0].inverse() * p).z() - 0.01;
      EXPECT_GT(above_plate, 0.002) << "body " << body;
    }
  }
}

/// Where rays gather, the contour is seen at one part of a pixel only, and found too far out or in.
TEST(ContourPointsOfAStraightEdge, LieEvenlyAlongIt) {
  ArticulatedModel model;
  Body body;
  body.mesh = make_box({0.3, 0.3, 0.02});
  model.tree.bodies.push_back(body);
  FieldOptions options;
  options.voxel = 0.003;
  model.fields.emplace_back(build_field(body.mesh, options, Executor(1)));
  BodyPoses poses(1, Eigen::Isometry3d::Identity());
  poses[0].translation().z() = 0.8;
  poses[0].linear() = Eigen::AngleAxisd(0.13, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  VisibleSurface surface;
  const PinholeCamera camera = refined(kCamera, 4);
  surface.render(model, poses, camera, camera.width, Executor(1));
  const ContourPoints contours = contours_of(model, surface, 1, Executor(1));
  std::vector<double> along;
  for (std::size_t i = 0; i < contours.bands(); ++i) {
    for (const ContourPoint& point : contours.band(i)) {
      const Eigen::Vector3d& p = point.p_body;
      if (p.x() > 0.145 && std::abs(p.y()) < 0.13) along.push_back(p.y());
    }
  }
  ASSERT_GT(along.size(), 100U);
  std::sort(along.begin(), along.end());
  const double mean_gap = (along.back() - along.front()) / static_cast<double>(along.size() - 1);
  std::size_t gathered = 0;
  for (std::size_t i = 1; i < along.size(); ++i) {
    gathered += along[i] - along[i - 1] < 0.5 * mean_gap ? 1U : 0U;
  }
  EXPECT_LT(static_cast<double>(gathered), 0.05 * static_cast<double>(along.size()));
}

/// A plate with a low rail along its right edge, one body.
ArticulatedModel plate_with_rail() {
  ArticulatedModel model;
  Body body;
  body.mesh = make_box({0.3, 0.3, 0.02});
  append(body.mesh, transformed(make_box({0.02, 0.3, 0.008}),
                                Eigen::Isometry3d(Eigen::Translation3d(0.12, 0.0, 0.014))));
  model.tree.bodies.push_back(body);
  FieldOptions options;
  options.voxel = 0.003;
  model.fields.emplace_back(build_field(body.mesh, options, Executor(1)));
  return model;
}

/// Rays beside the rail touch the plate, and from there lead to its edge.
TEST(ContourPointsBesideARail, DoNotMoveOnToTheNextContour) {
  const ArticulatedModel model = plate_with_rail();
  BodyPoses poses(1, Eigen::Isometry3d::Identity());
  poses[0].translation().z() = 0.8;
  poses[0].linear() = (Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()) *
                       Eigen::AngleAxisd(0.25, Eigen::Vector3d::UnitY()))
                          .toRotationMatrix();
  VisibleSurface surface;
  const PinholeCamera camera = refined(kCamera, 4);
  surface.render(model, poses, camera, camera.width, Executor(1));
  const ContourPoints contours = contours_of(model, surface, 1, Executor(1));
  int at_front_edge = 0;
  for (std::size_t i = 0; i < contours.bands(); ++i) {
    for (const ContourPoint& point : contours.band(i)) {
      const Eigen::Vector3d& p = point.p_body;
      if (p.x() < 0.14 || std::abs(p.y()) > 0.14) continue;
      EXPECT_GT(p.z(), 0.01 - 0.003) << "the side is turned away: the front's edge is the contour";
      ++at_front_edge;
    }
  }
  EXPECT_GT(at_front_edge, 100);
}

}  // namespace
}  // namespace lockbox
