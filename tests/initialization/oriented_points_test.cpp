// SPDX-License-Identifier: BSD-3-Clause
// Points with normals, of a view and of a body.
#include "oriented_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "lockbox/mesh/primitives.hpp"

namespace lockbox {
namespace {

constexpr PinholeCamera kPointCamera{160, 120, 144.0, 144.0, 79.5, 59.5};
constexpr double kSpacing = 0.02;  // metres

/// A depth image that a test fills by rays.
class PointsOfAView : public ::testing::Test {
 protected:
  /// depth_of(ray): metres along the optical axis; 0: nothing is known.
  template <typename DepthOf>
  void fill(const DepthOf& depth_of) {
    for (int v = 0; v < kPointCamera.height; ++v) {
      for (int u = 0; u < kPointCamera.width; ++u) {
        at(u, v) = static_cast<float>(depth_of(kPointCamera.back_project(u, v, 1.0)));
      }
    }
  }
  float& at(int u, int v) { return depth_[static_cast<std::size_t>(v * kPointCamera.width + u)]; }

  std::vector<OrientedPoint> points(double noise = 0.0) const {
    return points_of_view({kPointCamera, depth_, noise}, kSpacing);
  }

 private:
  std::vector<float> depth_ = std::vector<float>(160UL * 120UL, 0.0F);
};

/// Through (0, 0, 1), facing the camera.
struct SlopedPlane {
  Eigen::Vector3d normal;
  double depth_along(const Eigen::Vector3d& ray) const { return normal.z() / normal.dot(ray); }
};

TEST_F(PointsOfAView, OfAPlaneLieInItAndFaceTheCamera) {
  const SlopedPlane plane{Eigen::Vector3d(0.3, -0.2, -1.0).normalized()};
  fill([&](const Eigen::Vector3d& ray) { return plane.depth_along(ray); });
  const auto found = points();
  ASSERT_GT(found.size(), 500U);
  for (const OrientedPoint& point : found) {
    const Eigen::Vector3d p = point.position.cast<double>();
    EXPECT_NEAR(plane.normal.dot(p - Eigen::Vector3d::UnitZ()), 0.0, 1e-5) << p.transpose();
    EXPECT_LT((point.normal.cast<double>() - plane.normal).norm(), 1e-4) << p.transpose();
  }
}

/// The plane is parallel to the image: all of its points are as far from each other. Strides are
/// whole pixels, rounded down: 2 of 2.88.
TEST_F(PointsOfAView, AreAboutTheSpacingApart) {
  fill([](const Eigen::Vector3d&) { return 1.0; });
  const auto found = points();
  for (const OrientedPoint& point : found) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const OrientedPoint& other : found) {
      if (&other == &point) continue;
      nearest = std::min(nearest, static_cast<double>((other.position - point.position).norm()));
    }
    EXPECT_NEAR(nearest, 2.0 / 144.0, 1e-5);
  }
  EXPECT_EQ(found.size(), 80U * 60U);
}

TEST_F(PointsOfAView, AreNotBetweenSurfacesOneBehindTheOther) {
  fill([](const Eigen::Vector3d& ray) { return ray.x() < 0.0 ? 0.8 : 1.0; });
  int near = 0;
  const auto found = points();
  for (const OrientedPoint& point : found) {
    const bool is_near = point.position.x() < 0.0F;
    EXPECT_NEAR(point.position.z(), is_near ? 0.8F : 1.0F, 1e-5F);
    EXPECT_LT((point.normal + Eigen::Vector3f::UnitZ()).norm(), 1e-4F);
    near += is_near ? 1 : 0;
  }
  EXPECT_GT(near, 500);
  EXPECT_GT(static_cast<int>(found.size()) - near, 500);
}

/// A sample is off by 3 mm, a point by what is left of it in the mean around it.
TEST_F(PointsOfAView, AreTheMeanOfNoiseAroundThem) {
  constexpr double kDepthNoise = 3e-3;  // 1/metre
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, kDepthNoise);
  fill([&](const Eigen::Vector3d&) { return 1.0 / (1.0 + noise(random)); });
  const auto found = points(kDepthNoise);
  ASSERT_GT(found.size(), 500U);
  double squares = 0.0;
  for (const OrientedPoint& point : found) {
    const double off = static_cast<double>(point.position.z()) - 1.0;
    squares += off * off;
  }
  // Of a window of 29 samples a plane's value in the middle errs by 1/sqrt(29) of one.
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(found.size())), kDepthNoise / std::sqrt(29.0),
              0.15 * kDepthNoise / std::sqrt(29.0));
}

TEST_F(PointsOfAView, AreNoneOfWhatIsSeenAtAGrazingAngle) {
  const auto slope = [](double degrees) {
    const double angle = degrees * M_PI / 180.0;
    return SlopedPlane{{std::sin(angle), 0.0, -std::cos(angle)}};
  };
  // In a few columns around the optical axis, where the ray is the axis.
  const auto count_at = [&](double degrees) {
    const SlopedPlane plane = slope(degrees);
    fill([&](const Eigen::Vector3d& ray) {
      return std::abs(ray.x()) < 0.015 ? plane.depth_along(ray) : 0.0;
    });
    return points(0.05).size();
  };
  EXPECT_GT(count_at(70.0), 50U);
  EXPECT_EQ(count_at(85.0), 0U);
}

TEST_F(PointsOfAView, AreNoneWhereTooLittleIsKnown) {
  fill([](const Eigen::Vector3d&) { return 0.0; });
  EXPECT_TRUE(points().empty());
  for (int u = 80; u < 87; ++u) at(u, 60) = 1.0F;
  EXPECT_TRUE(points().empty()) << "seven samples";
  for (int v = 58; v < 63; ++v) {
    for (int u = 78; u < 83; ++u) at(u, v) = 1.0F;
  }
  EXPECT_FALSE(points().empty());
}

/// Not in the origin of its frame.
TEST(PointsOfABody, CoverAllItsSidesAndPointOut) {
  const Eigen::Vector3d half(0.05, 0.03, 0.02);
  const Eigen::Vector3d centre(0.2, -0.1, 0.3);
  KinematicTree tree;
  tree.bodies.resize(1);
  tree.bodies[0].mesh = make_box(2.0 * half);
  for (auto& vertex : tree.bodies[0].mesh.vertices) vertex += centre;
  constexpr double kApart = 0.01;
  const auto found = points_of_body(tree, 0, kApart, Executor(1));
  std::array<int, 6> on_side{};
  for (const OrientedPoint& point : found) {
    const Eigen::Vector3d p = point.position.cast<double>() - centre;
    const Eigen::Vector3d n = point.normal.cast<double>();
    Eigen::Index axis = 0;
    const double along = n.cwiseAbs().maxCoeff(&axis);
    if (along < 0.99) continue;  // at an edge
    EXPECT_NEAR(p[axis], std::copysign(half[axis], n[axis]), 1e-3) << p.transpose();
    for (const Eigen::Index other : {(axis + 1) % 3, (axis + 2) % 3}) {
      EXPECT_LT(std::abs(p[other]), half[other] + 1e-3) << p.transpose();
    }
    ++on_side[static_cast<std::size_t>(2 * axis + (n[axis] > 0.0 ? 1 : 0))];
  }
  for (std::size_t side = 0; side < 6; ++side) {
    const auto axis = static_cast<Eigen::Index>(side / 2);
    const double area = 4.0 * half.prod() / half[axis];
    // No two are nearer than 0.75 of the spacing.
    EXPECT_GT(on_side[side], 0.5 * area / (kApart * kApart)) << "side " << side;
    EXPECT_LT(on_side[side], 2.5 * area / (kApart * kApart)) << "side " << side;
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const bool is_same_side = found[i].normal.dot(found[k].normal) > 0.99F;
      const double apart = static_cast<double>((found[i].position - found[k].position).norm());
      if (is_same_side) {
        EXPECT_GE(apart, 0.74 * kApart);
      }
    }
  }
}

}  // namespace
}  // namespace lockbox
