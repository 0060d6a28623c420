// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "lockbox/initialization/initializer.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "seen_model.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

/// Links in a row, each on a hinge on the one before.
ArticulatedModel chain(int links) {
  std::string text = "<robot name=\"chain\">";
  for (int i = 0; i < links; ++i) {
    const std::string name = std::to_string(i);
    text += "<link name=\"l" + name +
            "\"><visual><geometry><box size=\".03 .03 .02\"/></geometry></visual></link>";
    if (i == 0) continue;
    text += "<joint name=\"j" + name + "\" type=\"revolute\"><parent link=\"l" +
            std::to_string(i - 1) + "\"/><child link=\"l" + name +
            "\"/><origin xyz=\"0.04 0 0\"/><axis xyz=\"0 0 1\"/>"
            "<limit lower=\"-0.5\" upper=\"0.5\" effort=\"1\" velocity=\"1\"/></joint>";
  }
  const TemporaryFolder folder;
  return load_model(folder.write("chain.urdf", text + "</robot>"), with_cache());
}

/// How often something is drawn to find all joints of the chain.
int drawings(int links) {
  const ArticulatedModel model = chain(links);
  Configuration truth = rest_configuration(model.tree);
  truth.T_camera_base = facing_pose(0.9);
  std::vector<int> all(static_cast<std::size_t>(model.tree.variables()));
  std::iota(all.begin(), all.end(), 0);
  int asked = 0;
  InitializerOptions options;
  options.stop_request = [&asked] { return ++asked < 0; };
  Initializer(model, options, Executor(1))
      .find_joints(seen(model, truth, wall_behind(0.3)), truth, all);
  return asked;
}

/// With several positions of each followed, it would be hundreds of times as much.
TEST(JointChains, AreSoughtInATimeThatGrowsWithTheirLength) {
  EXPECT_LT(drawings(9), 8 * drawings(5));
}

/// Of the last ten alone several positions are followed.
TEST(JointChains, TakeHardlyLongerWhereTheyAreLong) {
  EXPECT_LT(2 * drawings(25), 3 * drawings(13));
}

class JointSearch : public ::testing::Test {
 protected:
  double position(const Configuration& configuration, const std::string& joint) const {
    return joint_position(model_.tree, configuration, joint_index(model_.tree, joint));
  }
  int variable(const std::string& joint) const {
    const int index = joint_index(model_.tree, joint);
    return model_.tree.joints[static_cast<std::size_t>(index)].variable;
  }

  const ArticulatedModel& model_ = shipped("lockbox");
  Configuration truth_ = [this] {
    Configuration configuration = rest_configuration(model_.tree);
    configuration.T_camera_base = facing_pose(1.3);
    set_joint_position(model_.tree, configuration, "door_bottom_left", 1.5);
    set_joint_position(model_.tree, configuration, "slider", 0.2);
    return configuration;
  }();
  TiledCloud cloud_ = seen(model_, truth_, wall_behind(0.6));
  Configuration start_ = [this] {
    Configuration configuration = rest_configuration(model_.tree);
    configuration.T_camera_base = truth_.T_camera_base;
    return configuration;
  }();
};

TEST_F(JointSearch, FindsADoorThatSwungUnseen) {
  const Configuration found = Initializer(model_, {}, Executor(1))
                                  .find_joints(cloud_, start_, {variable("door_bottom_left")})
                                  .configuration;
  EXPECT_NEAR(position(found, "door_bottom_left"), 1.5, 0.05);
}

/// Where little of a door is in view, its latch decides: HardScenes, DoorWhoseLatchStandsElsewhere.
TEST_F(JointSearch, FindsADoorAndWhatItCarriesTogether) {
  Configuration truth = truth_;
  set_joint_position(model_.tree, truth, "latch", -1.3);
  const TiledCloud cloud = seen(model_, truth, wall_behind(0.6));
  const Configuration found =
      Initializer(model_, {}, Executor(1))
          .find_joints(cloud, start_, {variable("door_bottom_left"), variable("latch")})
          .configuration;
  EXPECT_NEAR(position(found, "door_bottom_left"), 1.5, 0.05);
  EXPECT_NEAR(position(found, "latch"), -1.3, 0.1);
}

TEST_F(JointSearch, LeavesAllOthersWhereTheyAre) {
  const Configuration found = Initializer(model_, {}, Executor(1))
                                  .find_joints(cloud_, start_, {variable("door_bottom_left")})
                                  .configuration;
  EXPECT_EQ(position(found, "slider"), 0.0);
  EXPECT_EQ(found.T_camera_base.matrix(), start_.T_camera_base.matrix());
}

TEST_F(JointSearch, FindsLowProminence) {
  const Configuration found = Initializer(model_, {}, Executor(1))
                                  .find_joints(cloud_, start_, {variable("slider")})
                                  .configuration;
  EXPECT_NEAR(position(found, "slider"), 0.2, 0.003);
}

/// A turn's ends are one position: neither rivals the other.
TEST_F(JointSearch, FindsADiskHalfATurnAwayWithoutDoubt) {
  Configuration truth = truth_;
  set_joint_position(model_.tree, truth, "disk", -std::numbers::pi);
  const TiledCloud cloud = seen(model_, truth, wall_behind(0.6));
  const SoughtJoints found =
      Initializer(model_, {}, Executor(1)).find_joints(cloud, start_, {variable("disk")});
  const double off = position(found.configuration, "disk") - std::numbers::pi;
  EXPECT_NEAR(std::remainder(off, 2.0 * std::numbers::pi), 0.0, 0.05);
  EXPECT_GT(found.margins[static_cast<std::size_t>(variable("disk"))], 100.0);
}

TEST_F(JointSearch, SaysByHowMuchAPositionIsBetter) {
  const auto margins = Initializer(model_, {}, Executor(1))
                           .find_joints(cloud_, start_, {variable("door_bottom_left")})
                           .margins;
  const auto door = static_cast<std::size_t>(variable("door_bottom_left"));
  EXPECT_GT(margins[door], 1000.0);
  EXPECT_TRUE(std::isfinite(margins[door]));
  EXPECT_TRUE(std::isinf(margins[static_cast<std::size_t>(variable("slider"))]));
}

/// Whoever locks a joint knows where it stands, and the search is not to know better.
TEST_F(JointSearch, LeavesLockedJointsWhereTheyAre) {
  InitializerOptions options;
  const auto door = static_cast<std::size_t>(variable("door_bottom_left"));
  options.registration.locked.resize(static_cast<std::size_t>(model_.tree.variables()), false);
  options.registration.locked[door] = true;
  Initializer initializer(model_, options, Executor(1));
  const auto alone = initializer.find_joints(cloud_, start_, {variable("door_bottom_left")});
  EXPECT_EQ(position(alone.configuration, "door_bottom_left"), 0.0);
  Configuration held = start_;
  set_joint_position(model_.tree, held, "door_bottom_left", 1.5);
  EXPECT_EQ(position(initializer.find(cloud_).at(0).configuration, "door_bottom_left"), 0.0);
  const Configuration found = initializer.find(cloud_, held).at(0).configuration;
  EXPECT_EQ(position(found, "door_bottom_left"), 1.5);
  EXPECT_NEAR(position(found, "slider"), 0.2, 0.003);
}

}  // namespace
}  // namespace lockbox
