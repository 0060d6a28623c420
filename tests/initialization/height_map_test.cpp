// SPDX-License-Identifier: BSD-3-Clause
// What stands over a plane, cell by cell of the plane.
#include "height_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"

namespace lockbox {
namespace {

constexpr PinholeCamera kMapCamera{160, 120, 144.0, 144.0, 79.5, 59.5};
constexpr double kMapNoise = 1e-3;   // 1/metre
constexpr double kPlaneOff = 0.006;  // metres that a plane may be off
constexpr HeightMapSize kMapSize{0.01, 0.1, 5};

/// A depth is that of a pixel's middle: half a pixel beside it a plane of slope 0.7 has another.
constexpr double kHalfPixel = 0.7 * 0.5 / 144.0;  // metres

/// A plane through (0, 0, 1), and what a test puts before and behind it.
class HeightMapTest : public ::testing::Test {
 protected:
  void tilt(double slope) { normal_ = Eigen::Vector3d(slope, 0.0, -1.0).normalized(); }

  /// depth_of(ray, depth of the plane): metres; 0: nothing is known.
  template <typename DepthOf>
  HeightMap map_of(const DepthOf& depth_of, const HeightMapSize& size = kMapSize) const {
    std::vector<float> depth;
    for (int v = 0; v < kMapCamera.height; ++v) {
      for (int u = 0; u < kMapCamera.width; ++u) {
        const Eigen::Vector3d ray = kMapCamera.back_project(u, v, 1.0);
        depth.push_back(static_cast<float>(depth_of(ray, normal_.z() / normal_.dot(ray))));
      }
    }
    TiledCloud cloud;
    CloudOptions all;
    all.flying_pixel_jump = 0.0;
    cloud.assign(kMapCamera, depth, all, Executor(1));
    const CoarseView view(cloud, kMapCamera.width, Executor(1));
    PlanarRegion region;
    region.m = (normal_ / normal_.z()).cast<float>();
    // The middle of the image, in the plane.
    for (int v = 30; v < 90; ++v) {
      for (int u = 40; u < 120; ++u) {
        const Eigen::Vector3d p = view.point(u, v).cast<double>();
        if (p.z() > 0.0 && std::abs(normal_.dot(p - Eigen::Vector3d::UnitZ())) < 1e-4) {
          region.samples.push_back(view.index(u, v));
        }
      }
    }
    return height_map(view, region, kMapNoise, size);
  }

  /// The cell of the map nearest to where a point of the camera's frame stands over the plane.
  static std::size_t cell(const HeightMap& map, const Eigen::Vector3d& p_camera) {
    const Eigen::Vector3d p = map.T_camera_plane.inverse() * p_camera;
    const Eigen::Vector2d number = (p.head<2>() - map.corner) / map.cell_size;
    return map.index(static_cast<int>(std::lround(number.x())),
                     static_cast<int>(std::lround(number.y())));
  }
  Eigen::Vector3d in_plane(double x, double y) const {
    return {x, y, 1.0 - normal_.x() * x / normal_.z()};
  }

 private:
  Eigen::Vector3d normal_ = -Eigen::Vector3d::UnitZ();
};

TEST_F(HeightMapTest, APlaneStandsNowhereOverItself) {
  for (const double slope : {0.0, 0.7}) {
    tilt(slope);
    const HeightMap map = map_of([](const Eigen::Vector3d&, double plane) { return plane; });
    for (const double x : {-0.25, 0.0, 0.2}) {
      EXPECT_NEAR(map.heights[cell(map, in_plane(x, 0.1))], 0.0, slope > 0.0 ? kHalfPixel : 1e-5)
          << slope << ", " << x;
    }
  }
}

/// A block of 5 cm on a slope: its top is seen beside what it stands on.
TEST_F(HeightMapTest, ABlockStandsOverTheCellsUnderItNotOverThoseThatItHides) {
  constexpr double kHigh = 0.05;
  tilt(0.7);
  const Eigen::Vector3d n = Eigen::Vector3d(0.7, 0.0, -1.0).normalized();
  const auto is_on_block = [&](const Eigen::Vector3d& top) {
    const Eigen::Vector3d foot = top - kHigh * n;
    return foot.x() > 0.0 && foot.x() < 0.1 && std::abs(foot.y()) < 0.1;
  };
  const HeightMap map = map_of([&](const Eigen::Vector3d& ray, double plane) {
    const double top = (n.z() + kHigh) / n.dot(ray);
    return is_on_block(top * ray) ? top : plane;
  });
  for (const double x : {0.02, 0.05, 0.08}) {
    EXPECT_NEAR(map.heights[cell(map, in_plane(x, 0.0))], kHigh, kHalfPixel) << x;
  }
  EXPECT_NEAR(map.heights[cell(map, in_plane(-0.1, 0.0))], 0.0, kHalfPixel);
  EXPECT_NEAR(map.heights[cell(map, in_plane(0.05, 0.2))], 0.0, kHalfPixel);
  // What lies on the rays of the top's far end is hidden.
  const Eigen::Vector3d top = in_plane(0.09, 0.0) + kHigh * n;
  const Eigen::Vector3d hidden = top * (n.z() / n.dot(top));
  ASSERT_GT(hidden.x(), 0.11);
  EXPECT_TRUE(std::isnan(map.heights[cell(map, hidden)]));
}

TEST_F(HeightMapTest, DepthsUnderThePlaneAreToldUpToFiveCentimetres) {
  const HeightMap map = map_of([](const Eigen::Vector3d& ray, double plane) {
    if (std::abs(ray.y()) > 0.05) return plane;
    if (std::abs(ray.x() - 0.1) < 0.05) return plane + 0.03;
    return std::abs(ray.x() + 0.1) < 0.05 ? plane + 0.2 : plane;
  });
  EXPECT_NEAR(map.heights[cell(map, {0.1, 0.0, 1.0})], -0.03F, 1e-5F);
  EXPECT_EQ(map.heights[cell(map, {-0.1, 0.0, 1.0})], kBelow);
}

TEST_F(HeightMapTest, NothingIsKnownWhereNothingWasMeasuredOrLookedAt) {
  const HeightMap map = map_of([](const Eigen::Vector3d& ray, double plane) {
    return std::hypot(ray.x() - 0.1, ray.y()) < 0.05 ? 0.0 : plane;
  });
  EXPECT_TRUE(std::isnan(map.heights[cell(map, {0.1, 0.0, 1.0})]));
  EXPECT_FALSE(std::isnan(map.heights[cell(map, {0.2, 0.0, 1.0})]));
  const HeightMap wide =
      map_of([](const Eigen::Vector3d&, double plane) { return plane; }, {0.01, 0.6, 5});
  EXPECT_FALSE(std::isnan(wide.heights[cell(wide, {0.5, 0.0, 1.0})]));
  EXPECT_TRUE(std::isnan(wide.heights[cell(wide, {0.6, 0.0, 1.0})])) << "beside the image";
}

/// The region is 80 x 60 pixels of a plane at 1 m: 79/144 x 59/144 m.
TEST_F(HeightMapTest, ReachesBeyondTheRegionWithAMarginAround) {
  const auto plane_alone = [](const Eigen::Vector3d&, double plane) { return plane; };
  const HeightMap map = map_of(plane_alone);
  const auto [shorter, longer] = std::minmax(map.width, map.height);
  EXPECT_EQ(longer, static_cast<int>((79.0 / 144.0 + 0.2) / 0.01) + 1 + 2 * 5);
  EXPECT_EQ(shorter, static_cast<int>((59.0 / 144.0 + 0.2) / 0.01) + 1 + 2 * 5);
  EXPECT_EQ(map.margin, 5);
  const Eigen::Vector2d middle =
      map.corner + 0.5 * map.cell_size * Eigen::Vector2d(map.width - 1, map.height - 1);
  EXPECT_LT(
      (map.T_camera_plane * Eigen::Vector3d(middle.x(), middle.y(), 0.0) - Eigen::Vector3d::UnitZ())
          .norm(),
      1e-5);
  // Memory has a bound.
  const HeightMap fine = map_of(plane_alone, {0.001, 0.1, 5});
  EXPECT_EQ(std::max(fine.width, fine.height), 224 + 2 * 5);
}

/// 1/depth errs alike at all depths: heights by z^2 times that, along the normal.
TEST_F(HeightMapTest, HeightsAreAsUncertainAsTheDepthsAlongTheNormal) {
  tilt(0.7);
  const HeightMap map = map_of([](const Eigen::Vector3d&, double plane) { return plane; });
  const Eigen::Vector3d n = Eigen::Vector3d(0.7, 0.0, -1.0).normalized();
  for (const double x : {-0.25, 0.0, 0.2}) {
    const Eigen::Vector3d p = in_plane(x, 0.0);
    const double expected = std::abs(n.dot(p / p.z())) * kMapNoise * p.z() * p.z() + kPlaneOff;
    EXPECT_NEAR(map.sigmas[cell(map, p)], expected, 3e-5) << x;
  }
}

}  // namespace
}  // namespace lockbox
