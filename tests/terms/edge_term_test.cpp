// SPDX-License-Identifier: BSD-3-Clause
// The likelihood of the image at the model's own edges: the lockbox from a metre and a half.
#include "lockbox/terms/edge_term.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "initialization/seen_model.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/registration/articulated_registration.hpp"

namespace lockbox {
namespace {

constexpr std::uint64_t kNoiseFrames = 12;

/// At this configuration, with the patches that show edges in a view of it.
void linearize(EdgeTerm& term, const ArticulatedModel& model, const TiledCloud& cloud,
               const Configuration& at, std::size_t patches_per_joint, int reduction = 2) {
  BodyPoses poses;
  std::vector<BodyJacobian> jacobians;
  forward_kinematics(model.tree, at, poses);
  body_jacobians(model.tree, poses, jacobians);
  VisibleSurface view;
  view.render(model, poses, cloud.camera(), cloud.camera().width / reduction, Executor());
  term.linearize(cloud, view, ContinuedEdges(), patches_per_joint, poses, jacobians);
}

class LockboxEdges : public ::testing::Test {
 protected:
  LockboxEdges() {
    scene_.planes.push_back({SceneFrame::world, {0.0, 0.0, 2.6}, {0.0, 0.0, -1.0}, {8.0, 8.0}});
    truth_ = rest_configuration(model_.tree);
    truth_.T_camera_base.translation() << 0.05, -0.1, 1.5;
    truth_.T_camera_base.linear() =
        (Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(0.3, Eigen::Vector3d(0.2, 1.0, 0.5).normalized()))
            .toRotationMatrix();
    for (int v = 0; v < model_.tree.variables(); ++v) {
      const VariableLimits limits = variable_limits(model_.tree, v);
      truth_.q[v] = std::isfinite(limits.upper) ? 0.7 * limits.lower + 0.3 * limits.upper : 0.4;
    }
  }

  TiledCloud seen(std::uint64_t number) const {
    return lockbox::seen(model_, truth_, scene_, number);
  }

  void linearize(EdgeTerm& term, const TiledCloud& cloud, const Configuration& at,
                 std::size_t patches_per_joint = kAllPatches, int reduction = 2) const {
    lockbox::linearize(term, model_, cloud, at, patches_per_joint, reduction);
  }

  Eigen::VectorXd step(const EdgeTerm& term) const {
    return term.information().ldlt().solve(-term.gradient());
  }

  Eigen::VectorXd error(const Configuration& found) const {
    Eigen::VectorXd error(model_.tree.unknowns());
    error.head<6>() = log_se3(truth_.T_camera_base.inverse() * found.T_camera_base);
    error.tail(truth_.q.size()) = found.q - truth_.q;
    return error;
  }

  const ArticulatedModel& model_ = shipped("lockbox");
  Scene scene_;
  Configuration truth_;
};

TEST_F(LockboxEdges, AreMeasuredAsExactlyAsTheySay) {
  EdgeTerm term(model_.tree, {}, Executor());
  Eigen::ArrayXd normalized = Eigen::ArrayXd::Zero(model_.tree.unknowns());
  for (std::uint64_t number = 0; number < kNoiseFrames; ++number) {
    linearize(term, seen(number), truth_);
    ASSERT_GT(term.pixels(), 1000.0);
    EXPECT_NEAR(term.chi_squared() / term.pixels(), 1.0, 0.3);
    const Eigen::ArrayXd sigma = term.information().inverse().diagonal().cwiseSqrt();
    normalized += (step(term).array() / sigma).square() / static_cast<double>(kNoiseFrames);
  }
  EXPECT_NEAR(normalized.mean(), 1.0, 0.4);
  EXPECT_LT(normalized.maxCoeff(), 3.0) << normalized.transpose();
}

TEST_F(LockboxEdges, LeadBackInOneStep) {
  EdgeTerm term(model_.tree, {}, Executor());
  const TiledCloud cloud = seen(0);
  linearize(term, cloud, truth_);
  const Eigen::VectorXd at_truth = step(term);
  for (Eigen::Index i = 0; i < at_truth.size(); ++i) {
    const double off = 4.0 * std::sqrt(term.information().inverse()(i, i));
    Configuration start = stepped(truth_, off * Eigen::VectorXd::Unit(at_truth.size(), i));
    EdgeTerm there(model_.tree, {}, Executor());
    linearize(there, cloud, start);
    EXPECT_NEAR(step(there)[i], at_truth[i] - off, 0.35 * off) << "unknown " << i;
  }
}

/// Views from 1.1 to 2.3 m.
TEST_F(LockboxEdges, MakeAlignmentsMoreExact) {
  RegistrationOptions without;
  without.refine_at_edges = false;
  ArticulatedRegistration by_points(model_, without, Executor());
  ArticulatedRegistration by_edges(model_, {}, Executor());
  Eigen::ArrayXd of_points = Eigen::ArrayXd::Zero(model_.tree.unknowns());
  Eigen::ArrayXd of_edges = of_points;
  for (std::uint64_t number = 0; number < 2 * kNoiseFrames; ++number) {
    const double z = 1.1 + 0.05 * static_cast<double>(number);
    truth_.T_camera_base.translation() << 0.02 * z, -0.03 * z, z;
    const TiledCloud cloud = seen(number);
    // Relative to the distance's noise, lest far views count alone.
    const double weight = 1.0 / (z * z * z * z);
    of_points +=
        weight * error(by_points.align(cloud, truth_, {0.003, 6}).configuration).array().square();
    of_edges +=
        weight * error(by_edges.align(cloud, truth_, {0.003, 6}).configuration).array().square();
  }
  EXPECT_LT((of_edges / of_points).mean(), 0.85) << (of_edges / of_points).sqrt().transpose();
}

TEST_F(LockboxEdges, AreTheSameForAnyNumberOfThreads) {
  const TiledCloud cloud = seen(1);
  for (const std::size_t patches_per_joint : {kAllPatches, std::size_t{20}}) {
    EdgeTerm alone(model_.tree, {}, Executor(1));
    EdgeTerm three(model_.tree, {}, Executor(3));
    linearize(alone, cloud, truth_, patches_per_joint);
    linearize(three, cloud, truth_, patches_per_joint);
    EXPECT_EQ(alone.gradient(), three.gradient());
    EXPECT_EQ(alone.information(), three.information());
  }
}

/// They are sought in a view of fewer pixels, whose drawing is not what takes the time.
TEST_F(LockboxEdges, AreNearlyAllFoundInCoarseViews) {
  const TiledCloud cloud = seen(0);
  EdgeTerm term(model_.tree, {}, Executor());
  linearize(term, cloud, truth_, kAllPatches, 1);
  const double all = term.pixels();
  const Eigen::VectorXd told = term.information().diagonal();
  for (const int reduction : {2, 4}) {
    linearize(term, cloud, truth_, kAllPatches, reduction);
    EXPECT_GT(term.pixels(), 0.97 * all) << reduction;
    EXPECT_GT((term.information().diagonal().array() / told.array()).minCoeff(), 0.95) << reduction;
  }
}

TEST_F(LockboxEdges, TellMostOfJointsInFewPatches) {
  const TiledCloud cloud = seen(0);
  EdgeTerm term(model_.tree, {}, Executor());
  linearize(term, cloud, truth_);
  const double all = term.pixels();
  const Eigen::ArrayXd told = term.information().diagonal().tail(truth_.q.size());
  linearize(term, cloud, truth_, 30);
  const Eigen::ArrayXd by_few = term.information().diagonal().tail(truth_.q.size());
  EXPECT_LT(term.pixels(), 0.45 * all);
  EXPECT_GT((by_few / told).minCoeff(), 0.5) << (by_few / told).transpose();
  // The best ones: twice as many tell less than twice as much.
  linearize(term, cloud, truth_, 15);
  const Eigen::ArrayXd by_half = term.information().diagonal().tail(truth_.q.size());
  EXPECT_GT((by_half / by_few).minCoeff(), 0.55) << (by_half / by_few).transpose();
}

/// Without joints there is nothing to choose patches for, and few edges: all are compared.
TEST(RigidEdges, AreAllComparedForAnyNumberOfPatchesAJoint) {
  const ArticulatedModel& model = shipped("rigid_block");
  Configuration truth = rest_configuration(model.tree);
  truth.T_camera_base.translation() << 0.0, 0.0, 0.8;
  truth.T_camera_base.linear() =
      Eigen::AngleAxisd(2.4, Eigen::Vector3d(1.0, 0.4, 0.2).normalized()).toRotationMatrix();
  const TiledCloud cloud = seen(model, truth, wall_behind(0.5));
  EdgeTerm term(model.tree, {}, Executor());
  linearize(term, model, cloud, truth, kAllPatches);
  const Eigen::MatrixXd told = term.information();
  EXPECT_GT(term.pixels(), 0.0);
  linearize(term, model, cloud, truth, 30);
  EXPECT_EQ(term.information(), told);
}

TEST_F(LockboxEdges, TellNothingWhereNothingIs) {
  EdgeTerm term(model_.tree, {}, Executor());
  linearize(term, seen(0), truth_);
  ASSERT_GT(term.pixels(), 0.0);
  Configuration away = truth_;
  for (const double z : {-1.0, 0.0, 0.02, std::nan("")}) {
    away.T_camera_base.translation() << 30.0, 0.0, z;
    linearize(term, seen(0), away);
    EXPECT_EQ(term.pixels(), 0.0) << z;
    EXPECT_TRUE(term.information().isZero(0.0));
    EXPECT_TRUE(term.gradient().isZero(0.0));
  }
  DepthFrame nothing = seen_frame(model_, truth_, scene_);
  std::fill(nothing.depth.begin(), nothing.depth.end(), std::uint16_t{0});
  TiledCloud empty;
  empty.assign(nothing, {}, Executor());
  linearize(term, empty, truth_);
  EXPECT_EQ(term.pixels(), 0.0);
}

TEST_F(LockboxEdges, AreSeenAroundTheCameraWithoutHarm) {
  EdgeTerm term(model_.tree, {}, Executor());
  Configuration near = truth_;
  near.T_camera_base.translation() << 0.1, 0.1, 0.05;
  linearize(term, seen(0), near);
  EXPECT_TRUE(term.information().allFinite());
  EXPECT_TRUE(term.gradient().allFinite());
}

TEST_F(LockboxEdges, DoNotSpeakWhereAnArmIsInTheWay) {
  EdgeTerm term(model_.tree, {}, Executor());
  linearize(term, seen(2), truth_);
  const double alone = term.pixels();
  DepthFrame frame = seen_frame(model_, truth_, scene_, 2);
  for (int v = 0; v < frame.camera.height; ++v) {
    std::fill_n(frame.depth.begin() + static_cast<std::ptrdiff_t>(v) * frame.camera.width + 280, 60,
                std::uint16_t{900});
  }
  TiledCloud cloud;
  cloud.assign(frame, {}, Executor());
  linearize(term, cloud, truth_);
  EXPECT_LT(term.pixels(), 0.97 * alone);
  EXPECT_NEAR(term.chi_squared() / term.pixels(), 1.0, 0.3);
}

}  // namespace
}  // namespace lockbox
