// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/ray_touch.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "lockbox/mesh/primitives.hpp"
#include "lockbox/sdf/build_field.hpp"

namespace lockbox::kernels {
namespace {

constexpr std::size_t kRays = 40;  // no multiple of any number of lanes

/// Rays from a camera that pass 12 mm beside a body: four voxels.
struct Rays {
  explicit Rays(const Eigen::Vector3d& camera) : origin(camera.cast<float>()) {}

  void add(const Eigen::Vector3d& beside) {
    const Eigen::Vector3f q = beside.cast<float>();
    const Eigen::Vector3f d = (q - origin).normalized();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      p[axis][count] = q[static_cast<Eigen::Index>(axis)];
      direction[axis][count] = d[static_cast<Eigen::Index>(axis)];
    }
    ++count;
  }

  void touch_surface(const FieldView& field) {
    for (std::size_t i = count; i < padded(kRays); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        p[axis][i] = p[axis][0];
        direction[axis][i] = direction[axis][0];
      }
    }
    touch(field,
          {origin.data(),
           {direction[0].data(), direction[1].data(), direction[2].data()},
           padded(kRays)},
          {{p[0].data(), p[1].data(), p[2].data()},
           {normal[0].data(), normal[1].data(), normal[2].data()}});
  }

  Eigen::Vector3d point(std::size_t i) const {
    return Eigen::Vector3f(p[0][i], p[1][i], p[2][i]).cast<double>();
  }
  Eigen::Vector3d outwards(std::size_t i) const {
    return Eigen::Vector3f(normal[0][i], normal[1][i], normal[2][i]).cast<double>();
  }
  /// How far inside the cone of rays that touch the body a point lies, metres across its ray.
  static double across(const Eigen::Vector3d& camera, const Eigen::Vector3d& p,
                       const Eigen::Vector3d& edge, const Eigen::Vector3d& edge_direction) {
    const Eigen::Vector3d normal = (edge - camera).cross(edge_direction).normalized();
    return normal.dot(p - camera);
  }

  using Axis = std::array<float, padded(kRays)>;
  Eigen::Vector3f origin;
  std::array<Axis, 3> direction{};
  std::array<Axis, 3> p{};
  std::array<Axis, 3> normal{};
  std::size_t count = 0;
};

SignedDistanceField plate_field() {
  FieldOptions options;
  options.voxel = 0.003;
  return build_field(make_box({0.4, 0.3, 0.03}), options, Executor(1));
}

/// From straight above and from aside, where the side is turned away from the camera, or to it.
TEST(RayTouch, FindsTheEdgeThatEndsWhatTheCameraSees) {
  const SignedDistanceField field = plate_field();
  for (const double camera_x : {0.0, -0.4, 0.35}) {
    const Eigen::Vector3d camera(camera_x, 0.05, 1.0);
    const bool sees_side = camera_x > 0.2;
    const Eigen::Vector3d edge(0.2, 0.0, sees_side ? -0.015 : 0.015);
    Rays rays(camera);
    for (std::size_t i = 0; i < kRays; ++i) {
      const Eigen::Vector3d beside =
          edge + Eigen::Vector3d(0.012, -0.1 + 0.2 * static_cast<double>(i) / kRays, 0.0);
      // From where the ray passes the front: a side that is seen is followed to its end.
      const double front = (0.015 - camera.z()) / (beside.z() - camera.z());
      rays.add(camera + front * (beside - camera));
    }
    rays.touch_surface(field.view());
    for (std::size_t i = 0; i < kRays; ++i) {
      EXPECT_NEAR(Rays::across(camera, rays.point(i), edge, Eigen::Vector3d::UnitY()), 0.0, 2.5e-4)
          << "camera at " << camera_x << ", ray " << i;
      EXPECT_NEAR(rays.outwards(i).norm(), 1.0, 1e-5);
      EXPECT_GT(rays.outwards(i).x(), 0.5);
    }
  }
}

/// Of a cylinder that stands upright.
TEST(RayTouch, FindsWhereRaysGrazeARoundBody) {
  constexpr double kRadius = 0.1;
  FieldOptions options;
  options.voxel = 0.004;
  const SignedDistanceField field = build_field(make_cylinder(kRadius, 0.3), options, Executor(1));
  const Eigen::Vector3d camera(1.0, 0.0, 0.0);
  Rays rays(camera);
  for (std::size_t i = 0; i < kRays; ++i) {
    rays.add({0.02, kRadius + 0.012, -0.05 + 0.1 * static_cast<double>(i) / kRays});
  }
  rays.touch_surface(field.view());
  const double cosine = kRadius / camera.x();  // of the angle at the axis, in the plane z = 0
  for (std::size_t i = 0; i < kRays; ++i) {
    const Eigen::Vector3d p = rays.point(i);
    EXPECT_NEAR(p.head<2>().norm(), kRadius, 2e-4);
    EXPECT_NEAR(p.x() / kRadius, cosine, 0.05);
    EXPECT_NEAR(rays.outwards(i).dot((p - camera).normalized()), 0.0, 0.05);
  }
}

TEST(RayTouch, EveryInstructionSetOfTheMachineAgrees) {
  const SignedDistanceField field = plate_field();
  std::vector<Eigen::Vector3d> first;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    Rays rays({0.0, 0.05, 1.0});
    for (std::size_t i = 0; i < kRays; ++i) {
      rays.add({0.21, -0.1 + 0.2 * static_cast<double>(i) / kRays, 0.015});
    }
    rays.touch_surface(field.view());
    for (std::size_t i = 0; i < kRays; ++i) {
      if (first.size() < kRays) first.push_back(rays.point(i));
      EXPECT_LT((rays.point(i) - first[i]).norm(), 1e-5) << hwy::TargetName(target);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace lockbox::kernels
