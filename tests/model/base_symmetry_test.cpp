// SPDX-License-Identifier: BSD-3-Clause
// What the base alone does not tell.
#include <gtest/gtest.h>

#include <cmath>

#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/symmetry.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

TEST(BaseSymmetries, OfALampAreThoseOfItsFoot) {
  const TemporaryFolder folder;
  const ArticulatedModel model = load_model(folder.write("lamp.urdf", R"(<robot name="lamp">
  <link name="foot">
    <visual><geometry><cylinder radius="0.08" length="0.02"/></geometry></visual>
  </link>
  <link name="arm">
    <visual><origin xyz="0.1 0 0"/><geometry><box size="0.2 0.02 0.02"/></geometry></visual>
  </link>
  <joint name="hinge" type="revolute">
    <parent link="foot"/><child link="arm"/><origin xyz="0.02 0 0.03"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>)"),
                                            {});
  EXPECT_EQ(find_symmetries(model).size(), 1U);
  // Steps of 15 degrees about its axis, and upside down.
  EXPECT_GE(find_body_symmetries(model, 0).size(), 24U);
}

TEST(RoundAxes, AreOneOfACanAndAllOfABallOrOfNothing) {
  const TemporaryFolder folder;
  const auto axes_of = [&](const std::string& visual) {
    const std::string text = R"(<robot name="part"><link name="part">)" + visual +
                             R"(</link><link name="knob"><visual><geometry>
  <box size="0.02 0.02 0.02"/></geometry></visual></link><joint name="fix" type="prismatic">
  <parent link="part"/><child link="knob"/><limit lower="0" upper="1" effort="1" velocity="1"/>
</joint></robot>)";
    return load_model(folder.write("part.urdf", text), {}).round_axes;
  };
  const std::string can =
      R"(<visual><origin rpy="1.5707963267948966 0 0"/><geometry><cylinder radius="0.04" length="0.1"/></geometry></visual>)";
  ASSERT_EQ(axes_of(can).size(), 1U);
  EXPECT_NEAR(std::abs(axes_of(can).front().y()), 1.0, 1e-6);
  EXPECT_TRUE(
      axes_of(R"(<visual><geometry><box size="0.1 0.1 0.2"/></geometry></visual>)").empty());
  EXPECT_GE(axes_of(R"(<visual><geometry><sphere radius="0.05"/></geometry></visual>)").size(), 3U);
  EXPECT_EQ(axes_of("").size(), 3U);
}

/// On a foot, what a hinge about z carries.
int joint_turns_of(const std::string& visuals) {
  const TemporaryFolder folder;
  const ArticulatedModel model = load_model(folder.write("knob.urdf", R"(<robot name="knob">
  <link name="foot"><visual><geometry><box size="0.3 0.2 0.02"/></geometry></visual></link>
  <link name="knob">)" + visuals + R"(</link>
  <joint name="hinge" type="revolute">
    <parent link="foot"/><child link="knob"/><origin xyz="0.05 0.02 0.03"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
  </joint>
</robot>)"),
                                            {});
  return count_joint_turns(model, 0);
}

std::string blade(double turn) {
  return "<visual><origin rpy=\"0 0 " + std::to_string(turn) + "\" xyz=\"" +
         std::to_string(0.06 * std::cos(turn)) + ' ' + std::to_string(0.06 * std::sin(turn)) +
         " 0\"/><geometry><box size=\"0.1 0.02 0.01\"/></geometry></visual>";
}

TEST(JointTurns, AreThoseOfWhatTheJointCarries) {
  EXPECT_EQ(joint_turns_of(blade(0.0)), 1) << "a hand of a clock";
  EXPECT_EQ(joint_turns_of(blade(0.0) + blade(M_PI)), 2) << "a bar";
  EXPECT_EQ(joint_turns_of(blade(0.0) + blade(2.0 * M_PI / 3.0) + blade(4.0 * M_PI / 3.0)), 3);
  EXPECT_EQ(joint_turns_of("<visual><geometry><cylinder radius=\"0.05\" length=\"0.02\"/>"
                           "</geometry></visual>"),
            24);
  EXPECT_EQ(joint_turns_of("<visual><origin xyz=\"0.01 0 0\"/><geometry><cylinder radius=\"0.05\" "
                           "length=\"0.02\"/></geometry></visual>"),
            1)
      << "a cam";
}

/// Wherever its corners lie between the samples of its field.
TEST(BaseSymmetries, OfACubeAreTwentyFour) {
  const TemporaryFolder folder;
  for (const std::string edge : {"0.085", "0.0871", "0.12", "0.33"}) {
    const ArticulatedModel model =
        load_model(
            folder.write("cube.urdf", R"(<robot name="cube"><link name="cube"><visual>
  <geometry><box size=")" + edge + ' ' + edge +
                                          ' ' + edge + R"("/></geometry></visual></link></robot>)"),
            {});
    EXPECT_EQ(find_body_symmetries(model, 0).size(), 24U) << edge;
  }
}

/// A can with a handle, which is an eighth of its surface.
TEST(BaseSymmetries, OfAMugAreThoseOfMostOfIt) {
  const TemporaryFolder folder;
  const ArticulatedModel model =
      load_model(folder.write("mug.urdf", R"(<robot name="mug"><link name="mug">
  <visual><geometry><cylinder radius="0.04" length="0.1"/></geometry></visual>
  <visual><origin xyz="0.055 0 0"/><geometry><box size="0.03 0.01 0.06"/></geometry></visual>
</link></robot>)"),
                 {});
  EXPECT_EQ(find_body_symmetries(model, 0).size(), 2U);  // upside down
  EXPECT_GE(find_body_symmetries(model, 0, 0.75).size(), 24U);
}

}  // namespace
}  // namespace lockbox
