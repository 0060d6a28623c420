// SPDX-License-Identifier: BSD-3-Clause
// What the registration finds where PCL's programs have an ICP: any kind of cloud.
#include "lockbox/pcl/articulated_sdf_registration.hpp"

#include <pcl/common/transforms.h>

#include <algorithm>
#include <limits>
#include <random>
#include <thread>

#include "lockbox/core/error.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "pcl_registration_fixture.hpp"

namespace lockbox {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

class PclCloudsTest : public PclRegistrationTest {
 protected:
  PclCloudsTest() { prepare(registration); }

  void align(const Cloud::Ptr& cloud) {
    registration.setInputSource(cloud);
    registration.align(aligned, guess());
  }

  /// The scan's points without the image's order and without what was not measured.
  Cloud::Ptr unorganized() const {
    const auto points = pcl::make_shared<Cloud>();
    for (const pcl::PointXYZ& point : *scan) {
      if (std::isfinite(point.z)) {
        points->push_back(point);
      }
    }
    std::shuffle(points->begin(), points->end(), std::mt19937(3));
    return points;
  }

  Registration registration;
  Cloud aligned;
};

TEST_F(PclCloudsTest, AnUnorganizedCloudIsRegisteredWithoutJudgingWhatIsSeenThrough) {
  const Cloud::Ptr points = unorganized();
  points->push_back({1e30F, -1e30F, 1e30F});
  align(points);
  expect_truth(registration);
  EXPECT_EQ(registration.getExplainedShare(), 0.0);
  EXPECT_EQ(registration.getContradictedShare(), 0.0);
  EXPECT_EQ(registration.getStandardDeviations().size(), 9);
}

TEST_F(PclCloudsTest, AnUnorganizedCloudIsSeenFromItsSensorsOrigin) {
  Eigen::Isometry3f T_world_camera(Eigen::AngleAxisf(2.0F, Eigen::Vector3f(1, 2, 3).normalized()));
  T_world_camera.translation() << 2.0F, -1.0F, 0.5F;
  Cloud world;
  pcl::transformPointCloud(*unorganized(), world, T_world_camera.matrix());
  world.sensor_origin_.head<3>() = T_world_camera.translation();
  registration.setInputSource(world.makeShared());
  const Eigen::Matrix4f T_camera_world = T_world_camera.inverse().matrix();
  registration.align(aligned, guess() * T_camera_world);
  EXPECT_TRUE(registration.hasConverged());
  expect_truth((registration.getFinalTransformation() * T_world_camera.matrix()).cast<double>(),
               registration.getJointPositions());
}

TEST_F(PclCloudsTest, AnImageIsSeenFromThePoseOfItsSensor) {
  Eigen::Isometry3f T_world_camera(Eigen::AngleAxisf(2.0F, Eigen::Vector3f(1, 2, 3).normalized()));
  T_world_camera.translation() << 2.0F, -1.0F, 0.5F;
  Cloud world;
  pcl::transformPointCloud(*scan, world, T_world_camera.matrix());
  world.sensor_origin_.head<3>() = T_world_camera.translation();
  world.sensor_orientation_ = Eigen::Quaternionf(T_world_camera.rotation());
  registration.setInputSource(world.makeShared());
  const Eigen::Matrix4f T_camera_world = T_world_camera.inverse().matrix();
  registration.align(aligned, guess() * T_camera_world);
  EXPECT_TRUE(registration.hasConverged());
  expect_truth((registration.getFinalTransformation() * T_world_camera.matrix()).cast<double>(),
               registration.getJointPositions());
  EXPECT_GT(registration.getExplainedShare(), 0.9);
}

TEST_F(PclCloudsTest, AFlatImageFitsToManyCamerasSoTheStatedSensorCounts) {
  Cloud wall(scan->width, scan->height);
  std::size_t pixel = 0;
  for (int v = 0; v < frame.camera.height; ++v) {
    for (int u = 0; u < frame.camera.width; ++u, ++pixel) {
      wall[pixel].getVector3fMap() = frame.camera.back_project(u, v, 1.3).cast<float>();
    }
  }
  Eigen::Matrix4f start = truth.T_camera_base.matrix().cast<float>();
  start(2, 3) = 1.3F;  // the object stands in the wall
  registration.setMaximumIterations(1);
  const auto sigma_of = [&](const Cloud& cloud, const Eigen::Matrix4f& T_cloud_base) {
    registration.setInputSource(cloud.makeShared());
    registration.setJointPositions(truth.q);
    registration.align(aligned, T_cloud_base.inverse());
    return registration.getStandardDeviations().head<6>().eval();
  };
  const auto in_camera = sigma_of(wall, start);
  for (pcl::PointXYZ& point : wall) {
    point.z -= 0.6F;
  }
  wall.sensor_origin_.z() = -0.6F;
  start(2, 3) -= 0.6F;
  // Seen from the frame's origin, half as far away, depths would be four times as exact.
  EXPECT_TRUE(sigma_of(wall, start).isApprox(in_camera, 0.05));
}

TEST_F(PclCloudsTest, ASensorTurnedForDisplayOnlyIsNotBelieved) {
  scan->sensor_orientation_ =
      Eigen::Quaternionf(0.0F, 1.0F, 0.0F, 0.0F);  // as PCL's grabbers write
  align(scan);
  expect_truth(registration);
  EXPECT_GT(registration.getExplainedShare(), 0.9);
}

TEST_F(PclCloudsTest, TheCameraIsTheOneGiven) {
  registration.setCamera(frame.camera);
  align(scan);
  expect_truth(registration);
  EXPECT_GT(registration.getExplainedShare(), 0.9);
}

TEST_F(PclCloudsTest, AnImageThatTheCameraCannotHaveSeenIsMerePoints) {
  PinholeCamera other = frame.camera;
  other.fx *= 1.5;
  registration.setCamera(other);
  align(scan);
  expect_truth(registration);
  EXPECT_EQ(registration.getExplainedShare(), 0.0);
}

TEST_F(PclCloudsTest, PointsThatAreNotFiniteAreNotMeasured) {
  for (std::size_t i = 0; i < scan->size(); i += 3) {
    (*scan)[i].x = kUnknown;
  }
  for (std::size_t i = 1; i < scan->size(); i += 7) {
    (*scan)[i].z = std::numeric_limits<float>::infinity();
  }
  (*scan)[2].getVector3fMap() *= 1e30F;
  align(scan);
  expect_truth(registration);
  EXPECT_LT(registration.getContradictedShare(), 0.02);
  EXPECT_GT(registration.getAgreement().unknown, 0.3);
  EXPECT_LT(registration.getFitnessScore(1e-3), 1e-4);
}

TEST_F(PclCloudsTest, IndicesSelectWhatIsMatchedAndTheRestStillTellsWhatIsSeenThrough) {
  const auto near = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < scan->size(); ++i) {
    if ((*scan)[i].z < 1.0F) {  // the wall stands at 1.3 m
      near->push_back(static_cast<pcl::index_t>(i));
    }
  }
  registration.setIndices(near);
  align(scan);
  expect_truth(registration);

  RegistrationOptions held;
  held.fixed_base = true;
  held.locked = {true, true, true};
  registration.setOptions(held);
  Eigen::Isometry3f beside = Eigen::Isometry3f::Identity();
  beside.translation().x() = 0.2F;  // half the plate's width
  registration.align(aligned, beside.matrix() * registration.getFinalTransformation());
  EXPECT_GT(registration.getContradictedShare(), 0.3);
}

TEST_F(PclCloudsTest, PointsThatAreNotInTheIndicesPullNothing) {
  const auto all_but_arm = pcl::make_shared<pcl::Indices>();
  std::vector<Eigen::Isometry3d> T_camera_body;
  forward_kinematics(model.tree, truth, T_camera_body);
  const std::size_t arm = 2;
  ASSERT_EQ(model.tree.bodies[arm].name, "arm");
  for (std::size_t i = 0; i < scan->size(); ++i) {
    const Eigen::Vector3f p = (*scan)[i].getVector3fMap();
    if (!p.allFinite()) {
      continue;
    }
    double distance = 1.0;  // of the arm and the knob on it
    for (const std::size_t b : {arm, arm + 1}) {
      const Eigen::Vector3d p_body = T_camera_body[b].inverse() * p.cast<double>();
      distance = std::min<double>(distance, model.fields[b]->sample(p_body.cast<float>()).distance);
    }
    if (distance > 0.012) {
      all_but_arm->push_back(static_cast<pcl::index_t>(i));
    }
  }
  RegistrationOptions model_term_only;
  model_term_only.lambda_free = 0.0;
  model_term_only.collision = CollisionMode::off;
  model_term_only.refine_at_edges = false;
  registration.setOptions(model_term_only);
  align(scan);
  const double with_arm = registration.getStandardDeviations()[7];
  registration.setJointPositions(truth.q);
  registration.setIndices(all_but_arm);
  registration.setMaxCorrespondenceDistance(0.005);
  registration.align(aligned, truth.T_camera_base.inverse().matrix().cast<float>());
  EXPECT_GT(registration.getStandardDeviations()[7], 3.0 * with_arm);
}

TEST_F(PclCloudsTest, OptionsHoldWhatTheySay) {
  RegistrationOptions options;
  options.fixed_base = true;
  options.locked = {false, true, false};
  registration.setOptions(options);
  registration.setInputSource(scan);
  const Eigen::Matrix4f start = truth.T_camera_base.inverse().matrix().cast<float>();
  registration.align(aligned, start);
  EXPECT_TRUE(registration.getFinalTransformation().isApprox(start, 1e-5F));
  EXPECT_EQ(registration.getJointPositions()[1], joints_off()[1]);
  EXPECT_NEAR(registration.getJointPositions()[0], truth.q[0], 3e-3);
  EXPECT_EQ(registration.getStandardDeviations()[0], 0.0);
}

TEST_F(PclCloudsTest, BaseAndJointsAreThoseOfTheLastStep) {
  // Only that step heeds how far contours err alike.
  const auto transformation = [&](double contour_correlation) {
    RegistrationOptions options;
    options.contour_correlation = contour_correlation;
    Registration with_options;
    prepare(with_options);
    with_options.setOptions(options);
    with_options.setInputSource(scan);
    with_options.align(aligned, guess());
    return with_options.getFinalTransformation();
  };
  EXPECT_GT((transformation(1.0) - transformation(20.0)).norm(), 1e-5F);
}

TEST_F(PclCloudsTest, TwoObjectsInTwoThreadsFindWhatOneFindsTwice) {
  align(scan);
  const Eigen::Matrix4f alone = registration.getFinalTransformation();
  Eigen::Matrix4f found[2];
  const auto work = [&](int k) {
    Registration own;
    prepare(own);
    own.setInputSource(scan);
    Cloud own_aligned;
    for (int run = 0; run < 2; ++run) {
      own.setJointPositions(joints_off());
      own.align(own_aligned, guess());
    }
    found[k] = own.getFinalTransformation();
  };
  std::thread first(work, 0);
  std::thread second(work, 1);
  first.join();
  second.join();
  EXPECT_EQ(found[0], alone);
  EXPECT_EQ(found[1], alone);
}

TEST_F(PclCloudsTest, JointsGoInAndOutByName) {
  registration.setJointPosition("turn", 0.25);
  EXPECT_EQ(registration.getJointPosition("turn"), 0.25);
  EXPECT_EQ(registration.getJointPositions()[1], 0.25);
  registration.setJointPosition("slide", 0.05);
  EXPECT_DOUBLE_EQ(registration.getJointPosition("follow"), 0.8 * 0.05 + 0.01);
  EXPECT_THROW(registration.setJointPosition("follow", 0.0), InputError);
  EXPECT_THROW(registration.setJointPosition("no such joint", 0.0), InputError);
  EXPECT_THROW(registration.setJointPosition("turn", double{kUnknown}), InputError);
  EXPECT_THROW(registration.setJointPositions(Eigen::VectorXd::Zero(2)), InputError);
  EXPECT_THROW(Registration().setJointPosition("turn", 0.0), InputError);  // of which model?
}

}  // namespace
}  // namespace lockbox
