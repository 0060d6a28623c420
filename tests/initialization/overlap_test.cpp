// SPDX-License-Identifier: BSD-3-Clause
// Parts that stand within each other, and where they would not.
#include "overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seen_model.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

/// On a board a block (6 cm) that slides along x, with a wall in its way (x from 0.09 to 0.13), and
/// may shift by 5 mm along y; and one that slides along y, at last into the wall.
constexpr auto kWalledBoard = R"(<robot name="board">
  <link name="board">
    <visual><origin xyz="0 0 -0.01"/><geometry><box size="0.6 0.5 0.02"/></geometry></visual>
    <visual><origin xyz="0.11 0 0.04"/><geometry><box size="0.04 0.1 0.08"/></geometry></visual>
  </link>
  <link name="carriage"/>
  <link name="block"><visual><geometry><box size="0.06 0.06 0.06"/></geometry></visual></link>
  <link name="other"><visual><geometry><box size="0.06 0.06 0.06"/></geometry></visual></link>
  <joint name="slide" type="prismatic"><parent link="board"/><child link="carriage"/>
    <origin xyz="0 0 0.03"/><axis xyz="1 0 0"/>
    <limit lower="-0.1" upper="0.25" effort="1" velocity="1"/></joint>
  <joint name="shift" type="prismatic"><parent link="carriage"/><child link="block"/>
    <axis xyz="0 1 0"/><limit lower="-0.005" upper="0.005" effort="1" velocity="1"/></joint>
  <joint name="across" type="prismatic"><parent link="board"/><child link="other"/>
    <origin xyz="0.11 0.18 0.03"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.18" effort="1" velocity="1"/></joint>
</robot>)";

const ArticulatedModel& walled_board() {
  static const ArticulatedModel model = [] {
    const TemporaryFolder folder;
    return load_model(folder.write("board.urdf", kWalledBoard), with_cache());
  }();
  return model;
}

class OverlapFinderTest : public ::testing::Test {
 protected:
  int variable(const std::string& joint) const {
    const int index = joint_index(model_.tree, joint);
    return model_.tree.joints[static_cast<std::size_t>(index)].variable;
  }
  Configuration at(double slide) const {
    Configuration configuration = rest_configuration(model_.tree);
    configuration.q[slide_] = slide;
    return configuration;
  }

  const ArticulatedModel& model_ = walled_board();
  const int slide_ = variable("slide");
  const int shift_ = variable("shift");
  const int across_ = variable("across");
  OverlapFinder finder_{model_, CollisionTerm(model_, {})};
};

TEST_F(OverlapFinderTest, FindsABlockInAWall) {
  EXPECT_TRUE(finder_.overlaps(at(0.11), slide_)) << "in its middle";
  EXPECT_TRUE(finder_.overlaps(at(0.075), slide_)) << "by 15 mm";
  EXPECT_FALSE(finder_.overlaps(at(0.0), slide_));
  EXPECT_FALSE(finder_.overlaps(at(0.2), slide_)) << "behind it";
}

TEST_F(OverlapFinderTest, ContactIsNoOverlap) {
  EXPECT_FALSE(finder_.overlaps(at(0.06), slide_)) << "side against side";
  EXPECT_FALSE(finder_.overlaps(at(0.0605), slide_)) << "pressed by noise";
}

/// The other block is in the wall, which the first one cannot mend.
TEST_F(OverlapFinderTest, OnlyWhatTheVariableMovesCounts) {
  Configuration configuration = at(0.0);
  configuration.q[across_] = 0.17;
  ASSERT_TRUE(finder_.overlaps(configuration, across_));
  EXPECT_FALSE(finder_.overlaps(configuration, slide_));
  configuration = at(0.11);
  EXPECT_TRUE(finder_.overlaps(configuration, shift_)) << "it carries the block, too";
}

TEST_F(OverlapFinderTest, MovesABlockToTheNearerSideOfTheWall) {
  for (const bool is_before : {true, false}) {
    const Configuration start = at(is_before ? 0.08 : 0.14);
    const Configuration moved = finder_.with_moved(start, slide_);
    // The nearest free position, of 64 over the range.
    constexpr double kStep = 0.35 / 63.0;
    const double free = is_before ? 0.06 : 0.16;
    EXPECT_NEAR(moved.q[slide_], free, kStep + 0.003);
    EXPECT_FALSE(finder_.overlaps(moved, slide_));
    EXPECT_EQ(moved.q[shift_], start.q[shift_]);
    EXPECT_EQ(moved.q[across_], start.q[across_]);
    EXPECT_EQ(moved.T_camera_base.matrix(), start.T_camera_base.matrix());
  }
}

TEST_F(OverlapFinderTest, LeavesABlockWhereNothingIsMuchBetter) {
  EXPECT_EQ(finder_.with_moved(at(0.11), shift_).q, at(0.11).q) << "it overlaps everywhere";
  EXPECT_EQ(finder_.with_moved(at(0.2), slide_).q, at(0.2).q) << "it is free";
}

}  // namespace
}  // namespace lockbox
