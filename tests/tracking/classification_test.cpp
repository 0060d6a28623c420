// SPDX-License-Identifier: BSD-3-Clause
// Parts of which most is measured where the estimate has it, and some is not: a disk whose handle
// is elsewhere, a part that overlaps with where it is.
#include "lockbox/tracking/classification.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <tuple>

#include "initialization/seen_model.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "mechanism.hpp"
#include "wrong_joint.hpp"

namespace lockbox {
namespace {

class PartsThatArePartlyWrong : public ::testing::TestWithParam<WrongJoint> {
 protected:
  /// The estimate as it is, registered by no step.
  RegistrationResult as_it_is(const Configuration& estimate) {
    return registration_.align(cloud_, estimate, {0.0, 0});
  }

  const ArticulatedModel& model_ = shipped("lockbox");
  TrackerOptions options_;
  Configuration truth_ = [this] {
    Configuration configuration = rest_configuration(model_.tree);
    configuration.T_camera_base = facing_pose(1.25);
    set_joint_position(model_.tree, configuration, "block", 0.1);
    set_joint_position(model_.tree, configuration, "cylinder_horizontal", 0.06);
    return configuration;
  }();
  TiledCloud cloud_ = seen(model_, truth_, wall_behind(0.6));
  ArticulatedRegistration registration_{model_, options_.registration, Executor(1)};
};

TEST_P(PartsThatArePartlyWrong, AreContradictedAlone) {
  const int joint = joint_index(model_.tree, GetParam().name);
  const int variable = model_.tree.joints[static_cast<std::size_t>(joint)].variable;
  EXPECT_EQ(classify(as_it_is(truth_), options_), TrackingStatus::tracking);
  Configuration wrong = truth_;
  set_joint_position(model_.tree, wrong, GetParam().name,
                     joint_position(model_.tree, truth_, joint) + GetParam().off);
  const RegistrationResult& result = as_it_is(wrong);
  EXPECT_EQ(contradicted_variables(result, model_.tree, options_), std::vector<int>{variable});
  EXPECT_NE(classify(result, options_), TrackingStatus::tracking);
}

TEST(Classification, ACornerDoesNotSayWhereTheBoardIs) {
  const ArticulatedModel& model = shipped("lockbox");
  const TrackerOptions options;
  ArticulatedRegistration registration(model, options.registration, Executor(1));
  Configuration truth = rest_configuration(model.tree);
  for (const auto& [x, y, expected] : {std::tuple{0.4, 0.3, TrackingStatus::tracking},
                                       std::tuple{1.1, 0.95, TrackingStatus::uncertain}}) {
    truth.T_camera_base = Eigen::Translation3d(x, y, 0.0) * facing_pose(1.25);
    const TiledCloud cloud = seen(model, truth, wall_behind(0.6));
    const RegistrationResult& result = registration.align(cloud, truth, {0.0, 3});
    EXPECT_GT(result.agreement.explained, 0.9);
    EXPECT_EQ(classify(result, options), expected) << x;
  }
}

// The shipped board, metres from its origin.
constexpr double kBoardBack = 0.018;
constexpr double kBoardFront = 0.02;
// The mechanism's plate, and the wall behind what is measured of it.
constexpr double kPlateBack = 0.01;
constexpr double kWall = 1.3;

/// From 2 m a board stands out of the wall by less than a pixel's noise allows, but its sides do
/// as wholes.
TEST(Classification, ABoardOnAFarWallEndsThere) {
  const ArticulatedModel& model = shipped("lockbox");
  const TrackerOptions options;
  ArticulatedRegistration registration(model, options.registration, Executor(1));
  Configuration truth = rest_configuration(model.tree);
  for (const double distance : {2.0, 2.2}) {
    truth.T_camera_base = facing_pose(distance);
    const TiledCloud cloud = seen(model, truth, wall_behind(kBoardBack));
    const RegistrationResult& result = registration.align(cloud, truth, {0.0, 3});
    EXPECT_LT(result.contour.continued(), 0.5) << distance;
    EXPECT_EQ(classify(result, options), TrackingStatus::tracking) << distance;
  }
}

TEST(Classification, ABareWallGoesOn) {
  const ArticulatedModel& model = shipped("lockbox");
  const TrackerOptions options;
  ArticulatedRegistration registration(model, options.registration, Executor(1));
  Configuration behind_it = rest_configuration(model.tree);
  for (const double distance : {1.2, 2.0, 2.4}) {
    behind_it.T_camera_base = facing_pose(distance + 1.0);
    const TiledCloud cloud = seen(model, behind_it, wall_behind(-1.0));
    Configuration estimate = behind_it;
    estimate.T_camera_base = facing_pose(distance + kBoardFront);
    const RegistrationResult& result = registration.align(cloud, estimate, {0.005, 10});
    EXPECT_GT(result.agreement.explained, 0.5) << distance;
    EXPECT_GT(result.contour.continued(), options.most_continued) << distance;
    EXPECT_NE(classify(result, options), TrackingStatus::tracking) << distance;
  }
}

/// Noise may turn what is found in a wall so that the wall lies behind it on one side.
TEST(Classification, ABareWallGoesOnAroundAPlateThatIsAslantInIt) {
  const ArticulatedModel& model = mechanism();
  const TrackerOptions options;
  ArticulatedRegistration registration(model, options.registration, Executor(1));
  Configuration out_of_view = rest_configuration(model.tree);
  out_of_view.T_camera_base.translation() = Eigen::Vector3d(5.0, 0.0, 1.0);
  const TiledCloud wall = cloud_of(measured(model, out_of_view, "primesense"));
  const std::array<Eigen::Vector3d, 2> axes{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  for (const double tilt : {-0.03, -0.02, -0.01, 0.0, 0.01, 0.02, 0.03}) {
    for (const Eigen::Vector3d& axis : axes) {
      Configuration estimate = rest_configuration(model.tree);
      estimate.T_camera_base =
          Eigen::Translation3d(0.0, 0.0, kWall + kPlateBack) * Eigen::AngleAxisd(tilt, axis);
      const RegistrationResult& result = registration.align(wall, estimate, {0.0, 0});
      EXPECT_GT(result.agreement.explained, 0.9) << tilt;
      EXPECT_GT(result.contour.continued(), options.most_continued) << tilt;
    }
  }
}

/// A handful of points that stand for many pixels each are known no better than a handful.
TEST(Classification, FewPointsContradictNothingThatIsRight) {
  const ArticulatedModel& model = shipped("board_door_block");
  TrackerOptions options;
  options.registration.point_budget = 600;
  ArticulatedRegistration registration(model, options.registration, Executor(1));
  Configuration truth = rest_configuration(model.tree);
  truth.T_camera_base = facing_pose(1.2) * Eigen::AngleAxisd(0.27, Eigen::Vector3d::UnitX());
  for (std::uint64_t number = 0; number < 30; ++number) {
    truth.q = static_cast<double>(number) * Eigen::Vector2d(0.03, 0.006);
    const TiledCloud cloud = seen(model, truth, wall_behind(0.8), number);
    Configuration start = truth;
    start.T_camera_base.pretranslate(Eigen::Vector3d(0.002, 0.001, 0.001));
    EXPECT_TRUE(is_believable(registration.align(cloud, start, {0.002, 3}), options)) << number;
  }
}

/// A door that is seen along its face shows it in a few columns of pixels, each centimetres behind
/// the last: by half a pixel of jitter, or a tenth of a degree, much of it is measured behind.
TEST(Classification, ADoorSeenAlongItsFaceIsNotContradicted) {
  const ArticulatedModel& model = shipped("board_door_block");
  for (const std::size_t budget : {std::size_t{1000}, TrackerOptions{}.registration.point_budget}) {
    TrackerOptions options;
    options.registration.point_budget = budget;
    ArticulatedRegistration registration(model, options.registration, Executor(1));
    Configuration truth = rest_configuration(model.tree);
    truth.T_camera_base = facing_pose(1.2) * Eigen::AngleAxisd(-0.26, Eigen::Vector3d::UnitY());
    for (std::uint64_t number = 0; number < 50; ++number) {
      const double angle = 0.5 + 0.01 * static_cast<double>(number);
      set_joint_position(model.tree, truth, "door", angle);
      const TiledCloud cloud = seen(model, truth, wall_behind(0.8), number);
      for (const double off : {-0.002, 0.002}) {
        Configuration estimate = truth;
        set_joint_position(model.tree, estimate, "door", angle + off);
        const RegistrationResult& result =
            registration.align(cloud, estimate, {.iterations = 0, .is_predicted = true});
        const Agreement& door = result.body_agreement[1];
        EXPECT_FALSE(is_contradicted(door, options))
            << budget << " points, " << angle << ", " << off << ": " << door.precision();
      }
    }
  }
}

/// The end of a door that points at the camera is a strip of ten pixels. By a third of a pixel more
/// of its samples show what is behind than noise of the depth explains.
TEST(Classification, AStripThatIsAThirdOfAPixelOffIsNotContradicted) {
  const ArticulatedModel& model = shipped("board_door_block");
  TrackerOptions options;
  options.registration.point_budget = 1000;
  ArticulatedRegistration registration(model, options.registration, Executor(1));
  Configuration truth = rest_configuration(model.tree);
  truth.T_camera_base = facing_pose(1.2) * Eigen::AngleAxisd(-0.26, Eigen::Vector3d::UnitY());
  set_joint_position(model.tree, truth, "door", 1.05);
  constexpr double kThird = 0.0007;  // metres, of a pixel
  for (std::uint64_t number = 0; number < 12; ++number) {
    truth.T_camera_base.pretranslate(Eigen::Vector3d(kThird, 0.0, 0.0));
    const TiledCloud cloud = seen(model, truth, wall_behind(0.8), number);
    for (const double off : {-kThird, kThird}) {
      Configuration estimate = truth;
      estimate.T_camera_base.pretranslate(Eigen::Vector3d(off, 0.0, 0.0));
      const RegistrationResult& result =
          registration.align(cloud, estimate, {.iterations = 0, .is_predicted = true});
      EXPECT_GT(result.body_agreement[1].precision(), 0.9) << number << ", " << off;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Classification, PartsThatArePartlyWrong,
                         ::testing::Values(WrongJoint{"disk", 0.5}, WrongJoint{"disk", -1.5},
                                           WrongJoint{"disk", 3.1}, WrongJoint{"block", 0.03},
                                           WrongJoint{"cylinder_horizontal", 0.02},
                                           WrongJoint{"cylinder_vertical", 0.02}));

}  // namespace
}  // namespace lockbox
