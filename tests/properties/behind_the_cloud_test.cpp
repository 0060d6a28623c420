// SPDX-License-Identifier: BSD-3-Clause
// Property "lost behind the cloud": a configuration wholly behind the observed surface, where
// nothing pulls it out, is recognised and left.
#include <gtest/gtest.h>

#include "initialization/seen_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/tracking/classification.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox {
namespace {

class BehindTheCloud : public ::testing::TestWithParam<const char*> {
 protected:
  const ArticulatedModel& model_ = shipped(GetParam());
  const Configuration truth_ = *model_.parameters.initial_configuration;

  /// Before a wall, so that there is a cloud to be behind of everywhere.
  const DepthFrame frame_ = seen_frame(model_, truth_, wall_behind(0.6));

  Configuration thrown_back(double metres) const {
    Configuration configuration = truth_;
    const Eigen::Vector3d ray = truth_.T_camera_base.translation().normalized();
    configuration.T_camera_base.pretranslate(metres * ray);
    return configuration;
  }

  void expect_truth(const Configuration& found) const {
    const Eigen::Isometry3d error = truth_.T_camera_base.inverse() * found.T_camera_base;
    EXPECT_LT(error.translation().norm(), 0.005);
    EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.01);
  }
};

TEST_P(BehindTheCloud, IsRecognised) {
  TiledCloud cloud;
  cloud.assign(frame_, {}, Executor());
  ArticulatedRegistration registration(model_, {}, Executor());
  for (const double metres : {0.2, 0.3, 0.5}) {
    const RegistrationResult& found = registration.align(cloud, thrown_back(metres), {0.01, 10});
    EXPECT_LT(found.agreement.explained, 0.1) << metres;
    EXPECT_GT(found.agreement.occluded, 0.5) << metres;
    EXPECT_EQ(classify(found, {}), TrackingStatus::lost) << metres;
  }
}

TEST_P(BehindTheCloud, IsNotCalledTrackingIfItCannotBeLeft) {
  TrackerOptions options;
  options.search_anywhere = false;
  options.start_sigma = 0.01;
  Tracker tracker(model_, options);
  tracker.start(thrown_back(0.5));
  EXPECT_EQ(tracker.process(frame_).status, TrackingStatus::lost);
}

TEST_P(BehindTheCloud, IsLeft) {
  Tracker tracker(model_, {});
  tracker.start(thrown_back(0.3));
  const TrackingResult& result = tracker.process(frame_);
  EXPECT_EQ(result.status, TrackingStatus::tracking);
  expect_truth(result.configuration);
}

INSTANTIATE_TEST_SUITE_P(OfShippedModels, BehindTheCloud,
                         ::testing::Values("lockbox", "cabinet", "rigid_block"),
                         [](const auto& model) { return std::string(model.param); });

}  // namespace
}  // namespace lockbox
