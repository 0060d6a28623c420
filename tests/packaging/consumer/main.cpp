// SPDX-License-Identifier: BSD-3-Clause
// What a stranger does with the installed package: tracks a block in a depth image, and aligns a
// PCL cloud of it. The block's front is flat, one metre away, and all that there is to see.
#include <cstdio>

#include "lockbox/model/articulated_model.hpp"
#include "lockbox/pcl/articulated_sdf_registration.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace {

lockbox::DepthFrame flat_image() {
  lockbox::DepthFrame frame;
  frame.camera = {160, 120, 144.0, 144.0, 79.5, 59.5};
  frame.depth.assign(std::size_t{160} * 120, 1000);
  return frame;
}

bool tracks(const lockbox::ArticulatedModel& model) {
  lockbox::Tracker tracker(model, lockbox::TrackerOptions{});
  return tracker.process(flat_image()).status == lockbox::TrackingStatus::initializing;
}

bool registers(lockbox::ArticulatedModel model) {
  lockbox::ArticulatedSdfRegistration<pcl::PointXYZ> registration;
  registration.setModel(std::move(model));
  registration.setInputSource(lockbox::to_point_cloud(flat_image()));
  Eigen::Matrix4f guess = Eigen::Matrix4f::Identity();
  guess(2, 3) = -1.0F;  // the model's origin, one metre away
  pcl::PointCloud<pcl::PointXYZ> aligned;
  pcl::Registration<pcl::PointXYZ, pcl::PointXYZ>& as_pcl_knows_it = registration;
  as_pcl_knows_it.align(aligned, guess);
  std::printf("fitness %g\n", as_pcl_knows_it.getFitnessScore());
  return as_pcl_knows_it.hasConverged() && aligned.size() == std::size_t{160} * 120;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  lockbox::ArticulatedModel model = lockbox::load_model(argv[1]);
  std::printf("%s: %d joint variables\n", model.tree.name.c_str(), model.tree.variables());
  return tracks(model) && registers(std::move(model)) ? 0 : 1;
}
