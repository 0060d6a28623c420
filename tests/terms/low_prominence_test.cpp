// SPDX-License-Identifier: BSD-3-Clause
// A slider of 12 mm on a board, seen from where a depth errs by 11 mm.
#include "lockbox/terms/low_prominence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "initialization/seen_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/sensor/sensor_model.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/view/joint_prominence.hpp"

namespace lockbox {
namespace {

constexpr double kDistance = 2.2;

class FarSlider : public ::testing::Test {
 protected:
  FarSlider() {
    const int joint = joint_index(model_.tree, "slider");
    variable_ = model_.tree.joints[static_cast<std::size_t>(joint)].variable;
    scene_.planes.push_back({SceneFrame::world, {0.0, 0.0, 3.2}, {0.0, 0.0, -1.0}, {8.0, 8.0}});
    truth_ = rest_configuration(model_.tree);
    truth_.T_camera_base.translation() << 0.05, -0.1, kDistance;
    truth_.T_camera_base.linear() =
        (Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(0.3, Eigen::Vector3d(0.2, 1.0, 0.5).normalized()))
            .toRotationMatrix();
    truth_.q[variable_] = 0.11;
  }

  /// The box in frame `number`, which differ by their noise.
  TiledCloud seen(std::uint64_t number) const {
    return lockbox::seen(model_, truth_, scene_, number);
  }

  Configuration off_by(double metres) const {
    Configuration configuration = truth_;
    configuration.q[variable_] += metres;
    return configuration;
  }

  const ArticulatedModel& model_ = shipped("lockbox");
  int variable_ = 0;
  Scene scene_;
  Configuration truth_;
};

TEST_F(FarSlider, StandsOutByItsHeight) {
  const Eigen::VectorXd prominences = joint_prominences(model_);
  EXPECT_NEAR(prominences[variable_], 0.012, 0.0005);
  EXPECT_GT((prominences.array() > 0.03).count(), 6) << prominences.transpose();
  const RegistrationOptions options;
  EXPECT_NEAR(LowProminence(model_, options, Executor(1)).prominence(variable_, truth_),
              0.012 / options.noise.sigma_z(kDistance), 0.1);
}

TEST_F(FarSlider, IsFoundByAlignmentsAsExactlyAsTheySay) {
  ArticulatedRegistration registration(model_, {}, Executor());
  constexpr int kFrames = 12;
  double squares = 0.0;
  double normalized = 0.0;
  for (std::uint64_t number = 0; number < kFrames; ++number) {
    const RegistrationResult& found =
        registration.align(seen(number), off_by(0.005), {0.005, 8, false, 4});
    ASSERT_TRUE(found.observable[static_cast<std::size_t>(unknown_of(variable_))]);
    const double error = found.configuration.q[variable_] - truth_.q[variable_];
    squares += error * error / kFrames;
    normalized += std::pow(error / found.sigma[unknown_of(variable_)], 2) / kFrames;
  }
  EXPECT_LT(std::sqrt(squares), 0.0015);
  EXPECT_GT(normalized, 0.2);
  EXPECT_LT(normalized, 3.0);
}

TEST_F(FarSlider, IsLostInTheNoiseOfPoints) {
  RegistrationOptions options;
  options.match_low_prominence = false;
  options.refine_at_edges = false;
  ArticulatedRegistration registration(model_, options, Executor());
  double squares = 0.0;
  for (std::uint64_t number = 0; number < 4; ++number) {
    const auto& found = registration.align(seen(number), off_by(0.005), {0.005, 8, false, 4});
    squares += std::pow(found.configuration.q[variable_] - truth_.q[variable_], 2) / 4.0;
  }
  EXPECT_GT(std::sqrt(squares), 0.002);  // what the last test asks for is not for free
}

TEST_F(FarSlider, IsFoundAnywhereInItsRange) {
  LowProminence low_prominence(model_, {}, Executor(2));
  const TiledCloud cloud = seen(1);
  for (const double off : {-0.09, 0.08, 0.12}) {
    const auto found = low_prominence.find_anywhere(cloud, off_by(off), variable_);
    ASSERT_TRUE(found.better);
    EXPECT_NEAR(found.better->position, truth_.q[variable_], 0.004);
  }
}

/// A position at the end of what is looked at is better than its neighbour, and no match. (From
/// 18 mm below there is a dip within two pixels of where it was: that is followed.)
TEST_F(FarSlider, IsNotTakenToBeWhereItIsNoLongerLookedFor) {
  LowProminence low_prominence(model_, {}, Executor(2));
  truth_.T_camera_base.translation().z() = 1.4;
  const TiledCloud cloud = seen(1);
  int found = 0;
  for (const double off : {-0.03, -0.024, -0.012, 0.012, 0.018, 0.024, 0.03}) {
    const Configuration start = off_by(off);
    const auto match = low_prominence.find_near(cloud, start, variable_, start.q[variable_]);
    if (!match) continue;
    ++found;
    const double error = std::abs(match->position - truth_.q[variable_]);
    EXPECT_LT(error, 0.001 + 3.0 * std::sqrt(match->variance)) << off;
  }
  EXPECT_GE(found, 4);
}

TEST_F(FarSlider, IsToldWhereItStandsOutByAnError) {
  LowProminence low_prominence(model_, {}, Executor(2));
  truth_.T_camera_base.translation().z() = 1.4;
  for (std::uint64_t number = 0; number < 4; ++number) {
    EXPECT_TRUE(low_prominence.find_anywhere(seen(number), off_by(0.08), variable_).is_told);
  }
}

/// It has moved too fast to be in the window: dips of the noise there are no match.
TEST_F(FarSlider, IsSeldomFollowedToWhereItHasLeft) {
  LowProminence low_prominence(model_, {}, Executor(2));
  int followed = 0;
  int kept = 0;
  for (std::uint64_t number = 0; number < 12; ++number) {
    const TiledCloud cloud = seen(number);
    const Configuration left = off_by(number % 2 == 0 ? 0.08 : -0.08);
    followed += low_prominence.find_near(cloud, left, variable_, left.q[variable_]) ? 1 : 0;
    kept += low_prominence.find_near(cloud, truth_, variable_, truth_.q[variable_]) ? 1 : 0;
  }
  EXPECT_LE(followed, 3);
  EXPECT_GE(kept, 10);
}

/// Its windows and the errors that go together over them leave nothing of 12 mm.
TEST_F(FarSlider, IsNotToldByAStereoCameraWhereItIsWrong) {
  LowProminence low_prominence(model_, {}, Executor(2));
  truth_.T_camera_base.translation().z() = 1.9;
  const SensorModel sensor = sensor_model("d4xx");
  State state;
  state.configuration = truth_;
  Simulator simulator(model_.tree, sensor.camera, {scene_, {state}}, sensor, 7, Executor());
  int wrong = 0;
  for (int number = 0; number < 6; ++number) {
    DepthFrame frame;
    simulator.simulate(state, static_cast<std::uint64_t>(number), frame);
    TiledCloud cloud;
    cloud.assign(frame, {}, Executor());
    const RangeMatch found = low_prominence.find_anywhere(cloud, truth_, variable_);
    const bool is_right =
        !found.better || std::abs(found.better->position - truth_.q[variable_]) < 0.01;
    wrong += is_right ? 0 : 1;
    EXPECT_TRUE(is_right || !found.is_told);
  }
  EXPECT_GT(wrong, 0);  // or this tells nothing
}

TEST_F(FarSlider, IsNotMovedForNoise) {
  LowProminence low_prominence(model_, {}, Executor(2));
  for (std::uint64_t number = 0; number < 3; ++number) {
    EXPECT_FALSE(low_prominence.find_anywhere(seen(number), truth_, variable_).better);
  }
}

TEST_F(FarSlider, IsUnknownWhereNothingWasMeasured) {
  DepthFrame frame = seen_frame(model_, truth_, scene_);
  std::fill(frame.depth.begin(), frame.depth.end(), std::uint16_t{0});
  TiledCloud cloud;
  cloud.assign(frame, {}, Executor());
  EXPECT_FALSE(LowProminence(model_, {}, Executor(1)).find_near(cloud, truth_, variable_, 0.0));
  EXPECT_FALSE(
      LowProminence(model_, {}, Executor(1)).find_anywhere(cloud, truth_, variable_).better);
}

TEST_F(FarSlider, IsUnknownBehindTheCamera) {
  const TiledCloud cloud = seen(0);
  Configuration behind = truth_;
  behind.T_camera_base.translation().z() = -1.0;
  LowProminence low_prominence(model_, {}, Executor(2));
  EXPECT_TRUE(std::isinf(low_prominence.prominence(variable_, behind)));
  EXPECT_FALSE(low_prominence.find_near(cloud, behind, variable_, 0.1));
}

TEST_F(FarSlider, FitsAsWellAsItsNoiseLets) {
  RegionLikelihood region(model_.tree, {}, 4.0, Executor(2));
  const double q = truth_.q[variable_];
  const auto chi_squared =
      region.compare(seen(3), truth_, variable_, std::vector<double>{q, q + 0.02});
  ASSERT_EQ(chi_squared.size(), 2U);
  EXPECT_NEAR(chi_squared[0] / region.pixels(), 1.0, 0.3);
  EXPECT_GT(chi_squared[1], chi_squared[0] + 30.0);
}

}  // namespace
}  // namespace lockbox
