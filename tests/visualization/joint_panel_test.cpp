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
  const auto sliders = joint_sliders(tree_, configuration_, 0);
  ASSERT_THAT(sliders, SizeIs(2));
  EXPECT_EQ(sliders[0].name, "drawer");
  EXPECT_NEAR(sliders[0].upper, 250.0, 1e-9);
  EXPECT_NEAR(sliders[0].value, 100.0, 1e-9);
  EXPECT_NEAR(sliders[1].lower, -180.0, 1e-9);
  EXPECT_EQ(sliders[0].limits, "0.0 to 250.0");
  EXPECT_EQ(sliders[1].limits, "no limits");
  move_joint(tree_, 0, {0, 40.0}, configuration_);
  move_joint(tree_, 0, {1, 90.0}, configuration_);
  EXPECT_NEAR(configuration_.q(0), 0.04, 1e-12);
  EXPECT_NEAR(configuration_.q(1), 0.5 * std::numbers::pi, 1e-12);
}

TEST_F(JointPanel, SlidersOfManyJointsHavePages) {
  EXPECT_EQ(slider_pages(tree_), 0U);
  for (int i = 0; i < 14; ++i) add("j" + std::to_string(i), JointType::prismatic, 0.0, 1.0);
  EXPECT_EQ(slider_pages(tree_), 1U);
  EXPECT_EQ(slider_page_text(tree_, 0), "") << "all are there";
  for (int i = 14; i < 39; ++i) add("j" + std::to_string(i), JointType::prismatic, 0.0, 1.0);
  ASSERT_EQ(slider_pages(tree_), 3U);
  EXPECT_THAT(slider_page_text(tree_, 0), HasSubstr("joints 1 to 14 of 39"));
  EXPECT_THAT(slider_page_text(tree_, 2), HasSubstr("joints 29 to 39 of 39"));
  const auto last = joint_sliders(tree_, configuration_, 2);
  ASSERT_THAT(last, SizeIs(11));
  EXPECT_EQ(last.front().name, "j28");
  move_joint(tree_, 2, {1, 500.0}, configuration_);
  EXPECT_NEAR(configuration_.q(29), 0.5, 1e-12);
  EXPECT_NEAR(configuration_.q.sum(), 0.5, 1e-12) << "and no other";
}

}  // namespace
}  // namespace lockbox
