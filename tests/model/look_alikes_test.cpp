// SPDX-License-Identifier: BSD-3-Clause
// Configurations that no image tells apart, and what is none of them.
#include "lockbox/model/look_alikes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/symmetry.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

constexpr double kQuarter = std::numbers::pi / 2.0;

/// Looks the same in no other pose.
constexpr const char* kKnobbed =
    R"(<box size="0.08 0.06 0.2"/></geometry></visual><visual><origin xyz="0.05 0.01 0.05"/>)"
    R"(<geometry><box size="0.04 0.03 0.03"/>)";

struct Arm {
  std::string foot = R"(<box size="0.2 0.2 0.08"/>)";
  std::string first_link = R"(<box size="0.08 0.08 0.2"/>)";
  double limit = 1.2;
};

/// A column that turns upright on a foot, and bends twice.
ArticulatedModel load_arm(const Arm& arm) {
  const auto link = [](const std::string& name, const std::string& shape, double up) {
    return "<link name='" + name + "'><visual><origin xyz='0 0 " + std::to_string(up) +
           "'/><geometry>" + shape + "</geometry></visual></link>";
  };
  const auto joint = [&](const std::string& parent, const std::string& child, double up,
                         const std::string& axis) {
    const std::string limit = std::to_string(arm.limit);
    return "<joint name='to_" + child + "' type='revolute'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin xyz='0 0 " + std::to_string(up) +
           "'/><axis xyz='" + axis + "'/><limit lower='-" + limit + "' upper='" + limit +
           "' effort='1' velocity='1'/></joint>";
  };
  const TemporaryFolder folder;
  return load_model(
      folder.write("arm.urdf", "<robot name='arm'>" + link("foot", arm.foot, 0.0) +
                                   link("column", arm.first_link, 0.1) +
                                   link("upper", R"(<box size="0.06 0.05 0.2"/>)", 0.1) +
                                   link("lower", R"(<box size="0.05 0.04 0.2"/>)", 0.1) +
                                   joint("foot", "column", 0.04, "0 0 1") +
                                   joint("column", "upper", 0.2, "1 0 0") +
                                   joint("upper", "lower", 0.2, "0 1 0") + "</robot>"),
      {});
}

Configuration bent(const ArticulatedModel& model) {
  Configuration configuration = rest_configuration(model.tree);
  configuration.T_camera_base = Eigen::Translation3d(0.1, 0.2, 1.0) *
                                Eigen::AngleAxisd(2.0, Eigen::Vector3d(0.6, 0.0, 0.8).normalized());
  configuration.q << 0.5, 0.3, -0.4;
  return configuration;
}

/// All links lie where they did; which way round does not show.
void expect_that_axes_agree(const ArticulatedModel& model, const Configuration& a,
                            const Configuration& b) {
  BodyPoses poses_a;
  BodyPoses poses_b;
  forward_kinematics(model.tree, a, poses_a);
  forward_kinematics(model.tree, b, poses_b);
  for (std::size_t body = 1; body < poses_a.size(); ++body) {
    for (const double up : {0.0, 0.2}) {  // on the axis of the link
      const Eigen::Vector3d p(0.0, 0.0, up);
      EXPECT_LT((poses_a[body] * p - poses_b[body] * p).norm(), 2e-3) << body;
    }
  }
}

TEST(LookAlikes, OfAnArmOnASquareFootAreItsQuarterTurns) {
  const ArticulatedModel model = load_arm({});
  const Configuration configuration = bent(model);
  const std::vector<Configuration> found = LookAlikes(model).of(configuration);
  // Back by a quarter about the upright; what the column is turned by is within the limit: 0.5
  // - 1.57 is, and the half turn of the column itself, which bends to the other side, with -0.5
  // - 1.57 + pi.
  ASSERT_FALSE(found.empty());
  for (const Configuration& other : found) {
    EXPECT_GT(
        Eigen::AngleAxisd((configuration.T_camera_base.inverse() * other.T_camera_base).linear())
            .angle(),
        1.0);
    expect_that_axes_agree(model, configuration, other);
    EXPECT_LE(other.q.cwiseAbs().maxCoeff(), 1.2);
  }
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const Configuration& other) {
    return std::abs(other.q[0] - (0.5 - kQuarter)) < 0.01 && std::abs(other.q[1] - 0.3) < 0.01;
  }));
}

TEST(LookAlikes, AreNotBeyondLimits) {
  const ArticulatedModel wide = load_arm({.first_link = kKnobbed, .limit = 1.2});
  EXPECT_EQ(LookAlikes(wide).of(bent(wide)).size(), 1U);
  const ArticulatedModel narrow = load_arm({.first_link = kKnobbed, .limit = 0.7});
  EXPECT_TRUE(LookAlikes(narrow).of(bent(narrow)).empty());
}

TEST(LookAlikes, KeepWhatIsLocked) {
  const ArticulatedModel model = load_arm({.first_link = kKnobbed});
  EXPECT_TRUE(LookAlikes(model, {true, false, false}).of(bent(model)).empty());
}

TEST(LookAlikes, OfAFootThatIsLikeNoneOfItsTurnsAreNone) {
  const ArticulatedModel model =
      load_arm({.foot = R"(<box size="0.2 0.2 0.08"/></geometry></visual><visual><origin xyz=")"
                        R"(0.07 0.03 0.06"/><geometry><box size="0.04 0.04 0.06"/>)"});
  EXPECT_TRUE(LookAlikes(model).of(bent(model)).empty());
}

/// The turn of a round foot alone says nothing; that the column stands as before does.
TEST(LookAlikes, OfARoundFootAreNotItsTurnsAlone) {
  const ArticulatedModel model =
      load_arm({.foot = R"(<cylinder radius="0.1" length="0.08"/>)", .first_link = kKnobbed});
  ASSERT_EQ(model.round_axes.size(), 1U);
  EXPECT_TRUE(LookAlikes(model).of(bent(model)).empty());
}

/// Each of the round links looks the same in twelve turns within its limits, and the bolt beside
/// them in no turn of the foot: to try all would take days, and end by the test's time limit.
TEST(LookAlikes, AreSoughtInBoundedTime) {
  std::string elements =
      R"(<link name="foot"><visual><geometry><box size="0.2 0.2 0.05"/></geometry></visual></link>
<link name="bolt"><visual><geometry><box size="0.03 0.02 0.03"/></geometry></visual></link>
<joint name="slide" type="prismatic"><parent link="foot"/><child link="bolt"/>
  <origin xyz="0.08 0.06 0.03"/><axis xyz="1 0 0"/>
  <limit lower="0" upper="0.01" effort="1" velocity="1"/></joint>)";
  std::string parent = "foot";
  for (int i = 0; i < 10; ++i) {
    const std::string name = "link" + std::to_string(i);
    elements += "<link name='" + name +
                "'><visual><geometry><cylinder radius='0.03' length='0.08'/></geometry></visual>"
                "</link><joint name='j" +
                std::to_string(i) + "' type='revolute'><parent link='" + parent +
                "'/><child link='" + name +
                "'/><origin xyz='0 0 0.09'/><axis xyz='0 0 1'/>"
                "<limit lower='-0.1' upper='3' effort='1' velocity='1'/></joint>";
    parent = name;
  }
  const TemporaryFolder folder;
  const ArticulatedModel model =
      load_model(folder.write("arm.urdf", "<robot name='arm'>" + elements + "</robot>"), {});
  ASSERT_EQ(model.tree.bodies.back().name, "bolt") << "it is put last";
  EXPECT_TRUE(LookAlikes(model).of(rest_configuration(model.tree)).empty());
}

TEST(LookAlikes, OfWhatHasNoJointsAreNone) {
  const TemporaryFolder folder;
  const ArticulatedModel model =
      load_model(folder.write("box.urdf", R"(<robot name="box"><link name="box"><visual><geometry>
  <box size="0.1 0.1 0.2"/></geometry></visual></link></robot>)"),
                 {});
  EXPECT_TRUE(LookAlikes(model).of(rest_configuration(model.tree)).empty());
}

/// At rest a straight arm looks the same from four sides; bent it does not.
TEST(LastingSymmetries, OfAnArmAreNone) {
  const ArticulatedModel model = load_arm({.first_link = R"(<box size="0.08 0.06 0.2"/>)"});
  EXPECT_EQ(find_symmetries(model).size(), 2U);
  EXPECT_EQ(find_lasting_symmetries(model).size(), 1U);
}

}  // namespace
}  // namespace lockbox
