// SPDX-License-Identifier: BSD-3-Clause
// Joints that are sought from a body that is known, which need not be the base, and bodies that may
// be taken for the base.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "joint_scan.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/initialization/initializer.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/solver/motion_metric.hpp"
#include "mistaken_bases.hpp"
#include "point_match.hpp"
#include "seen_model.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

constexpr int kColumns = 160;    // of the view that is searched first
constexpr double kNoise = 6e-4;  // 1/metre: of the median of 4 x 4 pixels of a PrimeSense

std::string link(const std::string& name, const std::string& size, const std::string& middle) {
  return "<link name='" + name + "'><visual><origin xyz='" + middle + "'/><geometry><box size='" +
         size + "'/></geometry></visual></link>";
}

std::string hinge(const std::string& parent, const std::string& child, const std::string& where,
                  const std::string& axis, double lower, double upper) {
  return "<joint name='to_" + child + "' type='revolute'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin xyz='" + where + "'/><axis xyz='" + axis +
         "'/><limit lower='" + std::to_string(lower) + "' upper='" + std::to_string(upper) +
         "' effort='1' velocity='1'/></joint>";
}

ArticulatedModel loaded(const std::string& elements) {
  const TemporaryFolder folder;
  return load_model(folder.write("model.urdf", "<robot name='model'>" + elements + "</robot>"),
                    with_cache());
}

/// A plate that stands upright, an arm at its upper edge, and a smaller plate at the arm's end.
ArticulatedModel sign_on_an_arm() {
  return loaded(link("plate", "0.3 0.2 0.02", "0 0 0") + link("arm", "0.3 0.04 0.03", "0.15 0 0") +
                link("sign", "0.16 0.14 0.02", "0.08 0 0") +
                hinge("plate", "arm", "0.15 0.1 0", "0 0 1", -1.2, 1.2) +
                hinge("arm", "sign", "0.3 0 0", "0 0 1", -1.2, 1.2));
}

/// Two halves of nearly the same size.
ArticulatedModel laptop() {
  return loaded(link("base", "0.33 0.23 0.018", "0 0 0") +
                link("lid", "0.33 0.22 0.012", "0 -0.11 0") +
                hinge("base", "lid", "0 0.115 0.016", "1 0 0", -2.2, 0.0));
}

/// In a view of it, bent.
class HeldBody : public ::testing::Test {
 protected:
  HeldBody() { score_.set_view(view_); }

  Configuration bent() const {
    Configuration configuration = facing(model_, 1.0, 0.4, 0.2);
    configuration.q << 0.7, -0.9;
    return configuration;
  }

  const ArticulatedModel model_ = sign_on_an_arm();
  const Configuration truth_ = bent();
  const CoarseView view_{seen(model_, truth_, wall_behind(0.4)), kColumns, Executor(1)};
  ViewScore score_{model_.tree, kNoise};
};

TEST_F(HeldBody, StaysWhileTheBaseIsSoughtFromIt) {
  BodyPoses seen_poses;
  forward_kinematics(model_.tree, truth_, seen_poses);
  const std::size_t sign = 2;
  const Configuration start =
      with_body_held(SoughtModel(model_, {}), rest_configuration(model_.tree), sign,
                     seen_poses[sign])
          .configuration;
  const MotionMetric moves(model_.tree);
  ASSERT_GT(moves.between(start, truth_), 0.2);
  Configuration found = start;
  scan_joints(model_.tree, model_extent(model_.tree), score_, {0, 1}, 0.01, kScan, found, sign);
  EXPECT_LT(moves.between(found, truth_), 0.02);
  BodyPoses poses;
  forward_kinematics(model_.tree, found, poses);
  EXPECT_TRUE(poses[sign].isApprox(seen_poses[sign], 1e-9));
}

TEST_F(HeldBody, IsTheBaseUnlessAnotherIsNamed) {
  Configuration found = truth_;
  found.q.setZero();
  scan_joints(model_.tree, model_extent(model_.tree), score_, {0, 1}, 0.01, kScan, found);
  EXPECT_TRUE(found.T_camera_base.isApprox(truth_.T_camera_base, 0.0));
  EXPECT_LT((found.q - truth_.q).norm(), 0.1);
}

TEST(TellingBodies, AreTheLargestAndThoseThatAreNotMuchSmaller) {
  // The arm has a fifth of the plate's surface, the sign a third.
  const ArticulatedModel model = sign_on_an_arm();
  EXPECT_EQ(telling_bodies(model.tree), (std::vector<std::size_t>{0, 2, 1}));
  const ArticulatedModel lone =
      loaded(link("plate", "0.3 0.2 0.02", "0 0 0") + link("knob", "0.03 0.03 0.02", "0 0 0.02") +
             hinge("plate", "knob", "0 0 0", "0 0 1", -1.0, 1.0));
  EXPECT_EQ(telling_bodies(lone.tree), std::vector<std::size_t>{0});
}

/// The lid lies where the base was taken to be.
TEST(MistakenBases, AreTriedInPlaceOfBodiesOfTheirSize) {
  const ArticulatedModel model = laptop();
  const SoughtModel sought(model, {});
  Configuration answer = facing(model, 1.0, 0.3, 0.1);
  answer.q << -0.3;
  const auto mistaken = with_base_mistaken(sought, answer, answer);
  BodyPoses seen_poses;
  forward_kinematics(model.tree, answer, seen_poses);
  const auto puts = [&](std::size_t body, std::size_t there) {
    return std::any_of(mistaken.begin(), mistaken.end(), [&](const Hypothesis& hypothesis) {
      BodyPoses poses;
      forward_kinematics(model.tree, hypothesis.configuration, poses);
      const auto middle = [&](const BodyPoses& all, std::size_t b) {
        return all[b] * bounds(model.tree.bodies[b].mesh).center();
      };
      return hypothesis.held == body &&
             (middle(poses, body) - middle(seen_poses, there)).norm() < 1e-6;
    });
  };
  EXPECT_TRUE(puts(0, 1));
  EXPECT_TRUE(puts(1, 0));
  const ArticulatedModel sign = sign_on_an_arm();
  EXPECT_TRUE(
      with_base_mistaken(SoughtModel(sign, {}), answer, facing(sign, 1.0, 0.3, 0.1)).empty());
}

/// From so far away nobody can tell which half is which: both are answers, and neither is sure.
TEST(MistakenBases, OfALaptopFarAwayLeaveItUnsure) {
  const ArticulatedModel model = laptop();
  Configuration truth = facing(model, 1.9, 0.5, 0.3);
  truth.q << -0.25;
  Initializer initializer(model, {}, Executor(1));
  const auto found = initializer.find(seen(model, truth, wall_behind(0.5)));
  ASSERT_GE(found.size(), 2U);
  EXPECT_LT(found.front().belief, 0.99);
  const MotionMetric moves(model.tree);
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const Candidate& candidate) {
    return moves.between(candidate.configuration, truth) < 0.02;
  }));
}

}  // namespace
}  // namespace lockbox
