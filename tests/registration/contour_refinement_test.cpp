// SPDX-License-Identifier: BSD-3-Clause
// The step after the descent in which contours weigh what their pixels are worth.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "initialization/seen_model.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/solver/motion_metric.hpp"

namespace lockbox {
namespace {

/// A small block, far away: its sides are little but noise, its contours are sharp.
class FarBlock : public ::testing::Test {
 protected:
  FarBlock() : registration_(model_, options_, Executor()) {
    scene_.planes.push_back({SceneFrame::world, {0.0, 0.0, 3.2}, {0.0, 0.0, -1.0}, {8.0, 8.0}});
    truth_.T_camera_base.translation() << 0.1, -0.05, 2.3;
    truth_.T_camera_base.linear() =
        Eigen::AngleAxisd(2.5, Eigen::Vector3d(0.9, 0.3, 0.2).normalized()).toRotationMatrix();
    truth_.q.resize(0);
  }

  /// The block in frame `number`, which differ by their noise.
  TiledCloud seen(std::uint64_t number) const {
    return lockbox::seen(model_, truth_, scene_, number);
  }

  double turn_from_truth(const Configuration& found) const {
    return log_se3(truth_.T_camera_base.inverse() * found.T_camera_base).tail<3>().norm();
  }

  static RegistrationOptions by_contours() {
    RegistrationOptions options;
    options.refine_at_edges = false;
    return options;
  }

  const ArticulatedModel& model_ = shipped("rigid_block");
  const RegistrationOptions options_ = by_contours();
  ArticulatedRegistration registration_;
  Scene scene_;
  Configuration truth_;
};

TEST_F(FarBlock, IsFoundMoreExactlyThanByAllPixelsAlike) {
  double at_rest = 0.0;
  double refined = 0.0;
  for (std::uint64_t number = 0; number < 24; ++number) {
    const RegistrationResult& found = registration_.align(seen(number), truth_, {0.005, 8});
    at_rest += std::pow(turn_from_truth(found.at_rest), 2);
    refined += std::pow(turn_from_truth(found.configuration), 2);
  }
  EXPECT_LT(refined, 0.8 * at_rest);
}

TEST_F(FarBlock, IsFollowedAsIfContoursWeighedLikeAllElse) {
  RegistrationOptions heavier = options_;
  heavier.contour_correlation = 1.0;
  ArticulatedRegistration with_heavier(model_, heavier, Executor());
  const TiledCloud cloud = seen(0);
  const RegistrationResult& usual = registration_.align(cloud, truth_, {0.005, 8});
  const RegistrationResult& other = with_heavier.align(cloud, truth_, {0.005, 8});
  EXPECT_TRUE(usual.at_rest.T_camera_base.isApprox(other.at_rest.T_camera_base, 0.0));
  EXPECT_FALSE(usual.configuration.T_camera_base.isApprox(other.configuration.T_camera_base, 1e-7));
}

TEST_F(FarBlock, IsNotMovedFartherThanContoursAreLookedFor) {
  // Four standard deviations of half a pixel: 8 mm.
  for (const double off : {0.002, 0.005, 0.01, 0.02, 0.05}) {
    Configuration start = truth_;
    start.T_camera_base.translation().x() += off;
    const RegistrationResult& found = registration_.align(seen(0), start, {0.0, 0});
    EXPECT_TRUE(found.at_rest.T_camera_base.isApprox(start.T_camera_base, 0.0));
    EXPECT_LT(registration_.moves().between(found.configuration, start), 0.0081) << off;
  }
}

}  // namespace
}  // namespace lockbox
