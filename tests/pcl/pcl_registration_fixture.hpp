// SPDX-License-Identifier: BSD-3-Clause
// A scan of the mechanism, and a start some way off, for tests of PCL's face of the registration.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "lockbox/cloud/point_cloud.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/pcl/articulated_sdf_registration.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr converted(const pcl::PointCloud<pcl::PointXYZ>& cloud) {
  const auto points = pcl::make_shared<pcl::PointCloud<PointT>>();
  points->resize(cloud.width, cloud.height);
  points->header = cloud.header;
  points->is_dense = cloud.is_dense;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    (*points)[i].getVector3fMap() = cloud[i].getVector3fMap();
  }
  return points;
}

class PclRegistrationTest : public ::testing::Test {
 protected:
  using Cloud = pcl::PointCloud<pcl::PointXYZ>;
  using Registration = ArticulatedSdfRegistration<pcl::PointXYZ>;

  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  const DepthFrame frame = measured(model, truth, "primesense");
  const Cloud::Ptr scan = to_point_cloud(frame);

  /// Scan to model, about 15 mm and 3 degrees off.
  Eigen::Matrix4f guess() const {
    Twist offset;
    offset << 0.01, -0.01, 0.005, 0.03, 0.03, -0.03;
    return (truth.T_camera_base * exp_se3(offset)).inverse().matrix().cast<float>();
  }

  Eigen::VectorXd joints_off() const { return truth.q + Eigen::Vector3d(0.006, 0.05, -0.03); }

  /// The model lives as long as the program, so nobody owns it.
  std::shared_ptr<const ArticulatedModel> shared_model() const {
    return {&model, [](const ArticulatedModel*) {}};
  }

  template <typename AnyRegistration>
  void prepare(AnyRegistration& registration) const {
    registration.setModel(shared_model());
    registration.setJointPositions(joints_off());
    registration.setMaxCorrespondenceDistance(0.06);
    registration.setMaximumIterations(25);
    registration.setNumberOfThreads(1);
  }

  /// T: from the scan's camera to the model's base. In-plane the scan is good to 1.5 pixels.
  void expect_truth(const Eigen::Matrix4d& T, const Eigen::VectorXd& q) const {
    const Twist error = log_se3(Eigen::Isometry3d(T) * truth.T_camera_base);
    EXPECT_LT(error.head<2>().norm(), 3.6e-3);
    EXPECT_LT(std::abs(error[2]), 1e-3);
    EXPECT_LT(error.tail<3>().norm(), 8e-3);
    EXPECT_NEAR(q[0], truth.q[0], 3e-3);
    EXPECT_NEAR(q[1], truth.q[1], 0.03);
  }

  void expect_truth(Registration& registration) const {
    EXPECT_TRUE(registration.hasConverged());
    expect_truth(registration.getFinalTransformation().cast<double>(),
                 registration.getJointPositions());
  }
};

}  // namespace lockbox
