// SPDX-License-Identifier: BSD-3-Clause
// Property "determinism": the same input gives the same result, bit for bit, for any number of
// threads, whatever was computed before.
#include <gtest/gtest.h>

#include "initialization/seen_model.hpp"
#include "lockbox/initialization/initializer.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "registration/mechanism.hpp"
#include "sdf/field_fixture.hpp"

namespace lockbox {
namespace {

constexpr int kThreads[] = {1, 2, 3, 8};

void expect_same_bits(const Configuration& a, const Configuration& b) {
  EXPECT_EQ(a.T_camera_base.matrix(), b.T_camera_base.matrix());
  EXPECT_EQ(a.q, b.q);
}

TEST(Determinism, OfFields) {
  TriangleMesh mesh = make_cylinder(0.02, 0.05);
  append(mesh, moved(make_box({0.03, 0.03, 0.03}), 0.02, 0.0, 0.0));
  FieldOptions options;
  options.far_reach = 0.05;
  const SignedDistanceField one = build_field(mesh, options, Executor(1));
  for (const int threads : kThreads) {
    const SignedDistanceField other = build_field(mesh, options, Executor(threads));
    EXPECT_EQ(one.storage().samples, other.storage().samples);
    EXPECT_EQ(one.storage().block_first, other.storage().block_first);
    EXPECT_EQ(one.thickness(), other.thickness());
  }
}

class DeterminismOfOneRegistration : public ::testing::TestWithParam<std::size_t> {};

/// By point budget; 0: all points.
TEST_P(DeterminismOfOneRegistration, OnAnyNumberOfThreads) {
  RegistrationOptions options;
  options.point_budget = GetParam();
  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  const TiledCloud cloud = cloud_of(measured(model, truth, "primesense"));
  Eigen::VectorXd step = Eigen::VectorXd::Constant(model.tree.unknowns(), 0.005);
  step.segment<3>(3).setConstant(0.02);
  ArticulatedRegistration alone(model, options, Executor(1));
  const RegistrationResult first = alone.align(cloud, stepped(truth, step), {0.01, 5});
  for (const int threads : kThreads) {
    ArticulatedRegistration registration(model, options, Executor(threads));
    registration.align(cloud, truth, {0.02, 3});  // leaves its traces in the workspace
    const RegistrationResult& again = registration.align(cloud, stepped(truth, step), {0.01, 5});
    expect_same_bits(again.configuration, first.configuration);
    EXPECT_EQ(again.covariance, first.covariance);
    EXPECT_EQ(again.agreement.explained, first.agreement.explained);
    EXPECT_EQ(again.residual_rms, first.residual_rms);
    EXPECT_EQ(again.model_cost, first.model_cost);
    EXPECT_EQ(again.free_cost, first.free_cost);
  }
}

INSTANTIATE_TEST_SUITE_P(Budgets, DeterminismOfOneRegistration, ::testing::Values(0, 1500, 40000));

TEST(Determinism, OfTheSearchWithoutAGuess) {
  const ArticulatedModel& model = shipped("rigid_block");
  Configuration truth = rest_configuration(model.tree);
  truth.T_camera_base = facing_pose(0.9) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()) *
                        Eigen::AngleAxisd(-1.5, Eigen::Vector3d::UnitZ());
  const TiledCloud cloud = seen(model, truth, wall_behind(0.4));
  const auto one = Initializer(model, {}, Executor(1)).find(cloud);
  ASSERT_FALSE(one.empty());
  for (const int threads : kThreads) {
    const auto other = Initializer(model, {}, Executor(threads)).find(cloud);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].evidence, other[i].evidence);
      expect_same_bits(one[i].configuration, other[i].configuration);
    }
  }
}

std::vector<TrackingResult> tracked(const ArticulatedModel& model,
                                    const std::vector<DepthFrame>& frames,
                                    const Configuration& start, int threads) {
  TrackerOptions options;
  options.threads = threads;
  Tracker tracker(model, options);
  tracker.start(start);
  std::vector<TrackingResult> results;
  results.reserve(frames.size());
  for (const DepthFrame& frame : frames) {
    results.push_back(tracker.process(frame));
  }
  return results;
}

TEST(Determinism, OfARecording) {
  const ArticulatedModel& model = mechanism();
  std::vector<DepthFrame> frames;
  Configuration truth = mechanism_start(model);
  const Configuration start = truth;
  for (int k = 0; k < 8; ++k) {
    frames.push_back(measured(model, truth, "primesense", static_cast<std::uint64_t>(k)));
    frames.back().stamp = k / 30.0;
    truth.q[0] += 0.002;
    truth.q[1] -= 0.03;
  }
  const auto one = tracked(model, frames, start, 1);
  ASSERT_EQ(one.back().status, TrackingStatus::tracking);
  for (const int threads : kThreads) {
    const auto other = tracked(model, frames, start, threads);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      expect_same_bits(other[k].configuration, one[k].configuration);
      EXPECT_EQ(other[k].covariance, one[k].covariance);
      EXPECT_EQ(other[k].status, one[k].status);
      EXPECT_EQ(other[k].explained, one[k].explained);
    }
  }
}

}  // namespace
}  // namespace lockbox
