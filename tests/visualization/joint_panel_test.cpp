// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/joint_panel.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace lockbox {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class JointPanel : public testing::Test {
 protected:
  void add(const std::string& name, JointType type, double lower, double upper) {
    Joint joint;
    joint.name = name;
    joint.type = type;
    joint.lower = lower;
    joint.upper = upper;
    joint.variable = static_cast<int>(tree_.joints.size());
    tree_.file_order.push_back(joint.variable);
    tree_.variable_joint.push_back(joint.variable);
    tree_.joints.push_back(joint);
    configuration_.q = Eigen::VectorXd::Zero(joint.variable + 1);
  }

  KinematicTree tree_;
  Configuration configuration_;
};

TEST_F(JointPanel, HasNamePositionDeviationAndLimitsOfEachJoint) {
  add("drawer", JointType::prismatic, 0.0, 0.25);
  add("door", JointType::revolute, -0.5 * std::numbers::pi, 0.0);
  add("wheel", JointType::continuous, -kInfinity, kInfinity);
  add("latch", JointType::revolute, 0.0, std::numbers::pi);
  configuration_.q << 0.0123, -0.25 * std::numbers::pi, 0.0, 0.0;
  const auto panel = joint_panel(tree_, configuration_, {0.0005, kInfinity, 0.0, std::nan("")});
  EXPECT_EQ(panel,
            "\ndrawer    12.3 mm  ±0.5    0.0 to 250.0"
            "\ndoor     -45.0 °   unseen  -90.0 to 0.0"
            "\nwheel      0.0 °   held    no limits"
            "\nlatch      0.0 °           0.0 to 180.0");
}

TEST_F(JointPanel, SaysNothingOfDeviationsWhereNobodyTellsThem) {
  add("drawer", JointType::prismatic, 0.0, 0.25);
  EXPECT_EQ(joint_panel(tree_, configuration_, {}), "\ndrawer     0.0 mm  0.0 to 250.0");
}

TEST_F(JointPanel, LeavesOutWhatMimicsAnotherAndWhatDoesNotFit) {
  for (int i = 0; i < 40; ++i) add("j" + std::to_string(i), JointType::revolute, 0.0, 1.0);
  tree_.joints[3].is_mimic = true;
  const auto panel = joint_panel(tree_, configuration_, {});
  EXPECT_THAT(panel, Not(HasSubstr("\nj3 ")));
  EXPECT_THAT(panel, HasSubstr("\nj32 "));
  EXPECT_THAT(panel, HasSubstr("\nand 7 more"));
}

TEST_F(JointPanel, SlidersMoveTheirJointsWithinTheLimits) {
  add("drawer", JointType::prismatic, 0.0, 0.25);
  add("wheel", JointType::continuous, -kInfinity, kInfinity);
  configuration_.q << 0.1, 0.0;
  const auto sliders = joint_sliders(tree_, configuration_);
  ASSERT_THAT(sliders, SizeIs(2));
  EXPECT_EQ(sliders[0].name, "drawer");
  EXPECT_NEAR(sliders[0].upper, 250.0, 1e-9);
  EXPECT_NEAR(sliders[0].value, 100.0, 1e-9);
  EXPECT_NEAR(sliders[1].lower, -180.0, 1e-9);
  move_joint(tree_, {0, 40.0}, configuration_);
  move_joint(tree_, {1, 90.0}, configuration_);
  EXPECT_NEAR(configuration_.q(0), 0.04, 1e-12);
  EXPECT_NEAR(configuration_.q(1), 0.5 * std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace lockbox
