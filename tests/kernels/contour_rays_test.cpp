// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/contour_rays.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace lockbox::kernels {
namespace {

constexpr std::size_t kCount = 21;  // no multiple of any number of lanes
constexpr ViewIntrinsics kView{{142.5F, 140.0F}, {79.5F, 59.5F}};
constexpr Aside kAside{0.003F, 0.012F, 0.016F};

class Axes {
 public:
  explicit Axes(std::size_t axes) : values_(axes, std::vector<float>(padded(kCount), 1.0F)) {}
  float* operator[](std::size_t axis) { return values_[axis].data(); }
  Eigen::Vector3d vector(std::size_t i) const {
    return Eigen::Vector3f(values_[0][i], values_[1][i], values_[2][i]).cast<double>();
  }
  void set(std::size_t i, const Eigen::Vector3d& v) {
    for (std::size_t axis = 0; axis < values_.size(); ++axis) {
      values_[axis][i] = static_cast<float>(v[static_cast<Eigen::Index>(axis)]);
    }
  }

 private:
  std::vector<std::vector<float>> values_;
};

Eigen::Vector3d across(const Eigen::Vector3d& ray, const Eigen::Vector3d& v) {
  return v - ray.dot(v) / ray.squaredNorm() * ray;
}

Eigen::Vector2d project(const Eigen::Vector3d& p) {
  return {kView.focal_length[0] * p.x() / p.z() + kView.centre[0],
          kView.focal_length[1] * p.y() / p.z() + kView.centre[1]};
}

/// Pixels of a view, and the body that they show.
class ContourRaysTest : public ::testing::Test {
 protected:
  ContourRaysTest() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    T_body_camera = Eigen::Translation3d(0.2, -0.1, 1.1) *
                    Eigen::AngleAxisd(2.8, Eigen::Vector3d(1.0, 0.2, -0.1).normalized());
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        motion.rotation[3 * row + column] = static_cast<float>(T_body_camera.linear()(row, column));
      }
      motion.translation[row] = static_cast<float>(T_body_camera.translation()[row]);
    }
    for (std::size_t i = 0; i < kCount; ++i) {
      // Near ones, too, whose pixels are small.
      depth[i] = static_cast<float>(i % 3 == 0 ? 0.2 : 1.2 + 0.5 * uniform(random));
      at.set(i, {std::round(79.0 + 70.0 * uniform(random)),
                 std::round(59.0 + 50.0 * uniform(random)), 0.0});
      const double angle = 3.0 * uniform(random);
      normal.set(i, {std::cos(angle), std::sin(angle), 0.0});
      surface_normal.set(
          i, Eigen::Vector3d(uniform(random), uniform(random), uniform(random) + 1.5).normalized());
    }
  }

  void aim() {
    aim_beside({{at[0], at[1]}, depth.data(), {normal[0], normal[1]}, kCount}, kView, motion,
               kAside, aims(), ray_points().p);
  }
  ContourAims aims() {
    return {{p[0], p[1], p[2]}, {outwards[0], outwards[1], outwards[2]}, aside.data()};
  }
  TouchPoints ray_points() {
    return {{beside[0], beside[1], beside[2]},
            {surface_normal[0], surface_normal[1], surface_normal[2]}};
  }

  Eigen::Vector3d surface(std::size_t i) const {
    const Eigen::Vector3d ray((at.vector(i).x() - kView.centre[0]) / kView.focal_length[0],
                              (at.vector(i).y() - kView.centre[1]) / kView.focal_length[1], 1.0);
    return static_cast<double>(depth[i]) * ray;
  }

  template <typename Check>
  static void with_every_instruction_set(const Check& check) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      SCOPED_TRACE(hwy::TargetName(target));
      hwy::SetSupportedTargetsForTest(target);
      check();
    }
    hwy::SetSupportedTargetsForTest(0);
  }

  Eigen::Isometry3d T_body_camera = Eigen::Isometry3d::Identity();
  RigidMotion motion{};
  std::vector<float> depth = std::vector<float>(padded(kCount), 1.0F);
  std::vector<float> aside = std::vector<float>(padded(kCount), 0.0F);
  Axes at{3}, normal{3}, surface_normal{3}, p{3}, outwards{3}, beside{3}, direction{3};
};

TEST_F(ContourRaysTest, PassBesideTheirPixelsAlongTheContoursNormal) {
  with_every_instruction_set([this] {
    aim();
    for (std::size_t i = 0; i < kCount; ++i) {
      const Eigen::Vector3d in_camera = surface(i);
      EXPECT_LT((p.vector(i) - T_body_camera * in_camera).norm(), 1e-6);
      const Eigen::Vector3d out = T_body_camera.linear().transpose() * outwards.vector(i);
      EXPECT_NEAR(out.norm(), 1.0, 1e-5);
      EXPECT_NEAR(out.dot(in_camera.normalized()), 0.0, 1e-5) << "across the ray";
      const Eigen::Vector3d n(normal.vector(i).x() / kView.focal_length[0],
                              normal.vector(i).y() / kView.focal_length[1], 0.0);
      EXPECT_GT(out.dot(across(in_camera, n).normalized()), 1.0 - 1e-5);
      const double pixel = static_cast<double>(depth[i]) / kView.focal_length[0];
      const double way = pixel + std::clamp(0.016 - pixel, 0.003, 0.012);
      EXPECT_LT((beside.vector(i) - T_body_camera * (in_camera + way * out)).norm(), 2e-6);
    }
  });
}

TEST_F(ContourRaysTest, PassAlongTheSurfacesNormalsOnceTheyAreKnown) {
  with_every_instruction_set([this] {
    aim();
    float* const to[3] = {direction[0], direction[1], direction[2]};
    aim_along_normals(aims(), ray_points().normal, motion.translation, kCount, ray_points().p, to);
    for (std::size_t i = 0; i < kCount; ++i) {
      const Eigen::Vector3d on_surface = T_body_camera * surface(i);
      const Eigen::Vector3d ray = on_surface - T_body_camera.translation();
      const Eigen::Vector3d expected =
          on_surface +
          static_cast<double>(aside[i]) * across(ray, surface_normal.vector(i)).normalized();
      EXPECT_LT((beside.vector(i) - expected).norm(), 2e-6);
      const Eigen::Vector3d along = (expected - T_body_camera.translation()).normalized();
      EXPECT_LT((direction.vector(i) - along).norm(), 2e-6);
    }
  });
}

TEST_F(ContourRaysTest, TellWhereTheViewShowsWhatTheyTouch) {
  with_every_instruction_set([this] {
    aim();
    Axes unit(3);
    Axes image(4);
    std::vector<float> agreement(padded(kCount));
    std::vector<float> z(padded(kCount));
    look_at_touches(aims(), ray_points(), kView, motion, kCount,
                    {{unit[0], unit[1], unit[2]},
                     agreement.data(),
                     {image[0], image[1]},
                     {image[2], image[3]},
                     z.data()});
    for (std::size_t i = 0; i < kCount; ++i) {
      const Eigen::Vector3d touch = beside.vector(i);
      const Eigen::Vector3d out =
          across(touch - T_body_camera.translation(), surface_normal.vector(i));
      EXPECT_LT((unit.vector(i) - out.normalized()).norm(), 1e-5);
      EXPECT_NEAR(agreement[i], out.dot(outwards.vector(i)), 1e-5);
      const Eigen::Vector3d in_camera = T_body_camera.inverse() * touch;
      EXPECT_NEAR(z[i], in_camera.z(), 1e-6);
      EXPECT_NEAR(image[0][i], project(in_camera).x(), 1e-4);
      EXPECT_NEAR(image[1][i], project(in_camera).y(), 1e-4);
      const Eigen::Vector3d along = T_body_camera.linear().transpose() * out;
      EXPECT_NEAR(image[2][i], along.head<2>().normalized().x(), 1e-4);
      EXPECT_NEAR(image[3][i], along.head<2>().normalized().y(), 1e-4);
    }
  });
}

}  // namespace
}  // namespace lockbox::kernels
