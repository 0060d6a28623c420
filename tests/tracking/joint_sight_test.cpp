// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/joint_sight.hpp"

#include <gtest/gtest.h>

#include "mechanism.hpp"

namespace lockbox {
namespace {

/// A mechanism with three joint variables, each moving a body of its own.
class JointSightTest : public ::testing::Test {
 protected:
  /// An answer that determines the base, and of the joint variables those that are named.
  Answer determining(const std::vector<int>& variables) const {
    Answer answer;
    answer.observable.assign(static_cast<std::size_t>(tree.unknowns()), false);
    for (const int v : variables) answer.observable[static_cast<std::size_t>(unknown_of(v))] = true;
    answer.body_agreement.resize(tree.bodies.size());
    for (Agreement& body : answer.body_agreement) body.explained = 0.9;
    answer.flush_bodies.resize(tree.bodies.size(), false);
    return answer;
  }

  std::size_t body_of(int variable) const {
    const int joint = tree.variable_joint[static_cast<std::size_t>(variable)];
    return static_cast<std::size_t>(tree.joints[static_cast<std::size_t>(joint)].child_body);
  }

  const KinematicTree& tree = mechanism().tree;
  const TrackerOptions options{};
  JointSight sight{tree};
};

TEST_F(JointSightTest, SeeksAllJointsAtFirst) {
  EXPECT_EQ(sight.sought(), (std::vector<int>{0, 1, 2}));
}

TEST_F(JointSightTest, KnowsAJointFromTheSecondFrameOn) {
  sight.count(determining({0, 1, 2}), {}, options);
  EXPECT_FALSE(sight.is_known(1));
  sight.count(determining({0, 1}), {}, options);
  EXPECT_TRUE(sight.is_known(1));
  EXPECT_EQ(sight.sought(), std::vector<int>{2}) << "it was in sight in one frame only";
}

TEST_F(JointSightTest, ForgetsAJointAtOnceThatIsHidden) {
  for (int i = 0; i < 9; ++i) sight.count(determining({0, 1, 2}), {}, options);
  sight.count(determining({0, 2}), {}, options);
  EXPECT_EQ(sight.sought(), std::vector<int>{1});
}

TEST_F(JointSightTest, DoesNotCountAJointThatMayAsWellStandElsewhere) {
  JointMargins margins(3, 100.0);
  margins[2] = kNotTold;
  for (int i = 0; i < 3; ++i) sight.count(determining({0, 1, 2}), margins, options);
  EXPECT_EQ(sight.sought(), std::vector<int>{2});
}

TEST_F(JointSightTest, KnowsAtOnceWhatASearchDetermines) {
  sight.begin(determining({1}));
  EXPECT_EQ(sight.sought(), (std::vector<int>{0, 2}));
}

TEST_F(JointSightTest, DoesNotSeekAPartThatIsFlushWithWhatIsAroundIt) {
  Answer answer = determining({0});
  answer.flush_bodies[body_of(1)] = true;
  sight.begin(answer);
  sight.note_flush_parts(answer, options);
  EXPECT_EQ(sight.sought(), std::vector<int>{2});
  answer.body_agreement[body_of(1)].explained = 0.0;
  sight.note_flush_parts(answer, options);
  EXPECT_EQ(sight.sought(), (std::vector<int>{1, 2})) << "of a hidden one nobody knows";
}

/// A chain of twelve bodies in view of which nothing is known.
TEST(JointSightOfAChain, SeeksEightJointsAFrameAndAllInTurn) {
  KinematicTree chain;
  chain.bodies.resize(13);
  for (int j = 0; j < 12; ++j) {
    Joint joint;
    joint.parent_body = j;
    joint.child_body = j + 1;
    joint.variable = j;
    chain.joints.push_back(joint);
    chain.variable_joint.push_back(j);
  }
  JointSight sight(chain);
  Answer answer;
  answer.observable.assign(18, true);
  answer.body_agreement.resize(13);
  for (Agreement& body : answer.body_agreement) body.explained = 0.9;
  answer.flush_bodies.resize(13, false);
  EXPECT_EQ(sight.sought(), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
  sight.count(answer, {}, {});
  EXPECT_EQ(sight.sought(), (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8}));
  sight.count(answer, {}, {});
  EXPECT_TRUE(sight.is_known(7));
  EXPECT_FALSE(sight.is_known(0)) << "it was sought in one frame only";
  EXPECT_FALSE(sight.is_known(11)) << "it was not sought yet";
  for (int frame = 0; frame < 5; ++frame) {
    sight.sought();
    sight.count(answer, {}, {});
  }
  EXPECT_TRUE(sight.sought().empty());
}

}  // namespace
}  // namespace lockbox
