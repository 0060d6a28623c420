// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/bound.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "lockbox/mesh/primitives.hpp"

namespace lockbox {
namespace {

const PinholeCamera kSmallCamera{64, 48, 60.0, 60.0, 31.5, 23.5};
constexpr double kDepth = 1.0;                        // of the plate's front, metres
constexpr double kThickness = 0.02;                   // of the plate
constexpr double kNoise = 0.1;                        // of disparity, pixels
constexpr double kDisparity = 60.0 * 0.075 / kDepth;  // pixels, at the plate's front
// Depths come in whole millimetres, here in terms of disparity.
const double kMillimetre = 0.001 * kDisparity / kDepth / std::sqrt(12.0);

SensorModel sensor_with_jitter() {
  SensorModel sensor;
  sensor.disparity_noise = kNoise;
  sensor.lateral_jitter = 0.5;
  return sensor;
}

/// A plate of that size that faces the camera; its front is at kDepth, and slides along x.
KinematicTree sliding_plate(double width, double height) {
  KinematicTree tree;
  tree.bodies.resize(2);
  tree.bodies[1].mesh = make_box({width, height, kThickness});
  tree.bodies[1].parent_joint = 0;
  Joint joint;
  joint.type = JointType::prismatic;
  joint.axis = Eigen::Vector3d::UnitX();
  joint.child_body = 1;
  joint.variable = 0;
  tree.joints = {joint};
  tree.variable_joint = {0};
  tree.file_order = {0};
  return tree;
}

Configuration plate_at(double x, double y) {
  Configuration configuration;
  configuration.T_camera_base.translation() = Eigen::Vector3d(x, y, kDepth + kThickness / 2.0);
  configuration.q = Eigen::VectorXd::Zero(1);
  return configuration;
}

Eigen::MatrixXd information_of(const KinematicTree& tree, const Configuration& configuration,
                               const SensorModel& sensor, std::span<const RenderItem> scenery = {},
                               int threads = 1) {
  return DepthInformation(tree, kSmallCamera, sensor, Executor(threads))
      .compute(configuration, scenery);
}

RenderItem wall(const TriangleMesh& mesh, double depth) {
  RenderItem item;
  item.mesh = &mesh;
  item.T_camera_mesh.translation().z() = depth + kThickness / 2.0;
  return item;
}

// Every pixel measures the disparity F/z of a plate that fills the image, F = f baseline: moving it
// by dz changes each by -F/z^2 dz.
TEST(Bound, OfDepthSumsIndependentPixels) {
  const KinematicTree tree = sliding_plate(4.0, 4.0);
  const Eigen::MatrixXd information = information_of(tree, plate_at(0, 0), sensor_with_jitter());
  const double variance = kNoise * kNoise + kMillimetre * kMillimetre;
  const double expected = 64 * 48 * std::pow(kDisparity / kDepth, 2) / variance;
  EXPECT_NEAR(information(2, 2), expected, 1e-3 * expected);
  EXPECT_NEAR(bound_sigma(information)[2], 1.0 / std::sqrt(expected), 1e-3 / std::sqrt(expected));
}

// The whole covariance, pixel by pixel: C = white I + sigma^2 exp(-r^2 / (2 L^2)); moving the plate
// by dz changes each disparity by -F/z^2 dz.
TEST(Bound, OfDepthIsThatOfGeneralizedLeastSquaresUnderCorrelatedNoise) {
  const PinholeCamera camera{30, 20, 60.0, 60.0, 14.5, 9.5};
  SensorModel sensor = sensor_with_jitter();
  sensor.correlation_length = 3.0;
  sensor.disparity_step = 0.125;
  const double white = 0.125 * 0.125 / 12.0 + kMillimetre * kMillimetre;
  Eigen::MatrixXd covariance(600, 600);
  for (int i = 0; i < 600; ++i) {
    for (int j = 0; j < 600; ++j) {
      const double distance = std::hypot(i % 30 - j % 30, i / 30 - j / 30);
      covariance(i, j) = kNoise * kNoise * std::exp(-0.5 * std::pow(distance / 3.0, 2));
    }
    covariance(i, i) += white;
  }
  const Eigen::VectorXd derivative = Eigen::VectorXd::Constant(600, -kDisparity / kDepth);
  const double expected = derivative.dot(covariance.ldlt().solve(derivative));

  const KinematicTree tree = sliding_plate(4.0, 4.0);
  const double information =
      DepthInformation(tree, camera, sensor, Executor(1)).compute(plate_at(0, 0))(2, 2);
  EXPECT_NEAR(information, expected, 0.02 * expected);
}

TEST(Bound, IsInfiniteAlongAPlateThatFillsTheImage) {
  const KinematicTree tree = sliding_plate(4.0, 4.0);
  const Eigen::VectorXd sigma =
      bound_sigma(information_of(tree, plate_at(0, 0), sensor_with_jitter()));
  for (const int unknown : {0, 1, 5, 6}) EXPECT_TRUE(std::isinf(sigma[unknown])) << unknown;
  for (const int unknown : {2, 3, 4}) EXPECT_LT(sigma[unknown], 0.01) << unknown;
}

// Tilting about the camera's x axis through the plate's middle at height y changes the depth by y:
// sigma^2 of the tilt is that of a straight line's slope, sigma_z^2 / sum y^2.
TEST(Bound, OfTiltIsThatOfALineFit) {
  const KinematicTree tree = sliding_plate(4.0, 4.0);
  const Eigen::VectorXd sigma =
      bound_sigma(information_of(tree, plate_at(0, 0), sensor_with_jitter()));
  const double sigma_z = std::hypot(kNoise, kMillimetre) * kDepth / kDisparity;
  double squares = 0.0;
  for (int v = 0; v < 48; ++v) squares += 64 * std::pow((v - 23.5) / 60.0 * kDepth, 2);
  // Pixels at the border look inwards a little.
  EXPECT_NEAR(sigma[3], sigma_z / std::sqrt(squares), 3e-3 * sigma[3]);
}

// The plate's left edge at image column e before a wall: jitter makes the mean disparity of column
// u the step J blurred to J Phi((u - e) / s), with the variance J^2 Phi (1 - Phi) on top of the
// noise.
TEST(Bound, OfAnEdgeIsThatOfABlurredStep) {
  const double edge = 30.0 + 1.0 / 6.0;  // between two samples
  const double left = (edge - kSmallCamera.cx) / kSmallCamera.fx * kDepth;
  const KinematicTree tree = sliding_plate(4.0, 4.0);
  const TriangleMesh wall_mesh = make_box({8.0, 8.0, kThickness});
  const std::vector<RenderItem> scenery = {wall(wall_mesh, 1.1)};
  const Eigen::MatrixXd information =
      information_of(tree, plate_at(left + 2.0, 0), sensor_with_jitter(), scenery);

  const double step = kDisparity - kDisparity * kDepth / 1.1;
  double expected = 0.0;
  for (int u = 20; u < 40; ++u) {
    const double t = (u - edge) / 0.5;
    const double density = std::exp(-0.5 * t * t) / std::sqrt(2.0 * M_PI) / 0.5;
    const double share = 0.5 * std::erfc(-t / std::sqrt(2.0));
    const double variance =
        kNoise * kNoise + kMillimetre * kMillimetre * 0.9 + step * step * share * (1.0 - share);
    expected += 48 * std::pow(step * density * kSmallCamera.fx / kDepth, 2) / variance;
  }
  EXPECT_NEAR(information(0, 0), expected, 0.02 * expected);
  EXPECT_NEAR(information(6, 6), information(0, 0), 1e-9 * expected);  // the joint does the same
  EXPECT_LT(information(1, 1), 1e-6 * expected);
}

// The base has no shape of its own: whatever the hinge does, a motion of the base does too.
TEST(Bound, TellsApartOnlyWhatTheFrameTellsApart) {
  const TriangleMesh wall_mesh = make_box({8.0, 8.0, kThickness});
  const std::vector<RenderItem> scenery = {wall(wall_mesh, 1.5)};
  KinematicTree tree = sliding_plate(0.5, 0.4);
  SensorModel sensor = sensor_with_jitter();
  for (const double correlation_length : {0.0, 3.0}) {
    sensor.correlation_length = correlation_length;
    tree.joints[0].type = JointType::revolute;
    tree.joints[0].axis = Eigen::Vector3d::UnitZ();
    tree.joints[0].T_parent_joint.translation() = Eigen::Vector3d(0.1, 0.2, 0.0);
    const Eigen::VectorXd sigma =
        bound_sigma(information_of(tree, plate_at(-0.1, -0.2), sensor, scenery));
    for (const int unknown : {0, 1, 5, 6}) EXPECT_TRUE(std::isinf(sigma[unknown])) << unknown;
    for (const int unknown : {2, 3, 4}) EXPECT_LT(sigma[unknown], 0.1) << unknown;
  }
}

TEST(Bound, IsInfiniteForWhatIsHidden) {
  const TriangleMesh screen = make_box({8.0, 8.0, kThickness});
  const std::vector<RenderItem> scenery = {wall(screen, 0.5)};
  const Eigen::VectorXd sigma = bound_sigma(
      information_of(sliding_plate(0.5, 0.4), plate_at(0, 0), sensor_with_jitter(), scenery));
  for (const double deviation : sigma) EXPECT_TRUE(std::isinf(deviation));
}

TEST(Bound, GrowsWithDropOuts) {
  SensorModel sensor = sensor_with_jitter();
  const KinematicTree tree = sliding_plate(4.0, 4.0);
  const double complete = information_of(tree, plate_at(0, 0), sensor)(2, 2);
  sensor.dropout_rate = 0.5;
  // Half of the pixels.
  EXPECT_NEAR(information_of(tree, plate_at(0, 0), sensor)(2, 2), 0.5 * complete, 0.01 * complete);
}

TEST(Bound, DoesNotDependOnTheNumberOfThreads) {
  const TriangleMesh wall_mesh = make_box({8.0, 8.0, kThickness});
  const std::vector<RenderItem> scenery = {wall(wall_mesh, 1.1)};
  const KinematicTree tree = sliding_plate(0.5, 0.4);
  const auto with_threads = [&](int threads) {
    return information_of(tree, plate_at(0.01, 0.02), sensor_with_jitter(), scenery, threads);
  };
  EXPECT_EQ(with_threads(1), with_threads(2));
  EXPECT_EQ(with_threads(1), with_threads(3));
}

}  // namespace
}  // namespace lockbox
