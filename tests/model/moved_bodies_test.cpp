// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/moved_bodies.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lockbox {
namespace {

Joint between(int parent, int child, int variable) {
  Joint joint;
  joint.parent_body = parent;
  joint.child_body = child;
  joint.variable = variable;
  return joint;
}

/// Two arms of two bodies each; the second joint of one mimics the first of the other.
KinematicTree two_arms() {
  KinematicTree tree;
  tree.bodies.resize(5);
  tree.joints = {between(0, 1, 0), between(1, 2, 1), between(0, 3, 2), between(3, 4, 0)};
  tree.variable_joint = {0, 1, 2};
  return tree;
}

TEST(MovedBodies, AreThoseOfAJointAllThatTheyCarryAndAllThatMimicIt) {
  const KinematicTree tree = two_arms();
  using ::testing::ElementsAre;
  EXPECT_THAT(moved_bodies(tree, 0), ElementsAre(0, 1, 1, 0, 1));
  EXPECT_THAT(moved_bodies(tree, 1), ElementsAre(0, 0, 1, 0, 0));
  EXPECT_THAT(moved_bodies(tree, 2), ElementsAre(0, 0, 0, 1, 1));
}

/// Seen from the tip of the first arm, all beyond a joint moves: the base, and what else it bears.
TEST(MovedBodies, AreThoseBeyondAJointFromWhereABodyIsHeld) {
  const KinematicTree tree = two_arms();
  using ::testing::ElementsAre;
  EXPECT_THAT(moved_bodies(tree, 1, 2), ElementsAre(1, 1, 0, 1, 1));
  EXPECT_THAT(moved_bodies(tree, 0, 2), ElementsAre(1, 0, 0, 1, 1));
  EXPECT_THAT(moved_bodies(tree, 2, 2), ElementsAre(0, 0, 0, 1, 1));
  EXPECT_THAT(moved_bodies(tree, 2, 0), moved_bodies(tree, 2));
}

}  // namespace
}  // namespace lockbox
