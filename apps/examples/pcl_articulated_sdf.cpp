// SPDX-License-Identifier: BSD-3-Clause
// Finds an object in a scan, and how its joints stand, from its URDF and a rough guess of where it
// is in the camera's frame (metres, radians):
//   pcl_articulated_sdf scan.pcd model.urdf x y z roll pitch yaw
#include <pcl/common/io.h>
#include <pcl/common/transforms.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <cstdlib>
#include <exception>
#include <iostream>

#include "lockbox/pcl/articulated_sdf_registration.hpp"

int main(int argc, char** argv) try {
  using Point = pcl::PointNormal;
  if (argc != 9) {
    std::cerr << "usage: " << argv[0] << " scan.pcd model x y z roll pitch yaw\n";
    return 2;
  }
  pcl::PointCloud<pcl::PointXYZ> points;
  if (pcl::io::loadPCDFile(argv[1], points) != 0) {
    return 1;
  }
  const auto scan = pcl::make_shared<pcl::PointCloud<Point>>();
  pcl::copyPointCloud(points, *scan);
  float pose[6];
  for (int i = 0; i < 6; ++i) {
    pose[i] = std::strtof(argv[3 + i], nullptr);
  }
  const Eigen::Affine3f T_camera_model =
      pcl::getTransformation(pose[0], pose[1], pose[2], pose[3], pose[4], pose[5]);

  lockbox::ArticulatedSdfRegistration<Point> registration;
  registration.setModel(lockbox::load_model(argv[2]));
  registration.setInputSource(scan);
  registration.setMaxCorrespondenceDistance(0.05);
  registration.setMaximumIterations(40);
  registration.setTransformationEpsilon(1e-10);
  pcl::PointCloud<Point> aligned;
  registration.align(aligned, T_camera_model.inverse().matrix());

  std::cout << "converged: " << registration.hasConverged() << '\n'
            << "fitness score: " << registration.getFitnessScore(0.05) << '\n'
            << "pose of the model:\n"
            << registration.getFinalTransformation().inverse() << '\n'
            << "joints: " << registration.getJointPositions().transpose() << '\n';
  return registration.hasConverged() ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
