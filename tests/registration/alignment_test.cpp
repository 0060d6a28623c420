// SPDX-License-Identifier: BSD-3-Clause
// What one registration step promises: it finds the configuration, keeps what it was told to keep,
// and respects limits.
#include <gtest/gtest.h>

#include <cmath>

#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "mechanism.hpp"

namespace lockbox {
namespace {

class AlignmentTest : public ::testing::Test {
 protected:
  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  const TiledCloud cloud = cloud_of(measured(model, truth, "primesense"));

  Configuration displaced(double metres, double radians) const {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(model.tree.unknowns());
    step.head<6>() << metres, -metres, metres, radians, radians, -radians;
    step[6] = 0.5 * metres;
    step[7] = radians;
    step[8] = 0.5 * radians;
    return stepped(truth, step);
  }

  Twist base_error(const Configuration& found) const {
    return log_se3(truth.T_camera_base.inverse() * found.T_camera_base);
  }
};

TEST_F(AlignmentTest, FindsBaseAndJointsFromAnOffset) {
  ArticulatedRegistration registration(model, {}, Executor(1));
  const RegistrationResult& result = registration.align(cloud, displaced(0.015, 0.05), {0.02, 25});
  const Twist error = base_error(result.configuration);
  EXPECT_LT(error.head<3>().norm(), 2.4e-3);  // one pixel: 0.7 m / 287.9
  EXPECT_LT(error.tail<3>().norm(), 5e-3);
  EXPECT_NEAR(result.configuration.q[0], truth.q[0], 2e-3);
  EXPECT_NEAR(result.configuration.q[1], truth.q[1], 0.02);
  EXPECT_GT(result.agreement.explained, 0.9);
  EXPECT_LT(result.agreement.contradicted, 0.02);
}

/// Contours are seen in whole pixels: what lies across the view must neither stick to them, nor go
/// to and fro between two of them.
TEST_F(AlignmentTest, RestsWithinASmallPartOfAPixel) {
  constexpr double kPixel = 0.7 / 287.9;  // metres
  ArticulatedRegistration registration(model, {}, Executor(1));
  double squares = 0.0;
  constexpr int kPhases = 8;
  for (int phase = 0; phase < kPhases; ++phase) {
    Configuration shifted = truth;
    shifted.T_camera_base.pretranslate(
        Eigen::Vector3d(phase * kPixel / kPhases, 0.4 * phase * kPixel / kPhases, 0.0));
    const TiledCloud seen = cloud_of(measured(model, shifted, "white", 5));
    const RegistrationResult& result = registration.align(seen, truth, {0.005, 20, false, 6});
    const Configuration& found = result.configuration;
    EXPECT_EQ(result.last_move, 0.0) << "phase " << phase;
    squares += (found.T_camera_base.translation() - shifted.T_camera_base.translation())
                   .head<2>()
                   .squaredNorm();
    EXPECT_NEAR(found.q[0], shifted.q[0], 0.2 * kPixel) << "phase " << phase;
  }
  EXPECT_LT(std::sqrt(squares / kPhases), 0.1 * kPixel);
}

/// Squares of errors against the truth, in the reported standard deviations.
double squared_errors(const RegistrationResult& found, const Configuration& truth) {
  Eigen::VectorXd off(found.sigma_of_noise.size());
  off << log_se3(truth.T_camera_base.inverse() * found.configuration.T_camera_base),
      found.configuration.q - truth.q;
  return off.cwiseQuotient(found.sigma_of_noise).squaredNorm();
}

/// From a prediction a few points lead near, and the last step is that of all of them: near enough,
/// or several millimetres off still.
TEST_F(AlignmentTest, FromAPredictionErrsAndIsSureAsFromAnywhere) {
  RegistrationOptions options;
  options.point_budget = 0;
  ArticulatedRegistration registration(model, options, Executor(1));
  for (const double off : {0.002, 0.012}) {
    Configuration start = truth;
    start.T_camera_base.pretranslate(Eigen::Vector3d(off, -off, off));
    start.q[0] += off;
    double usual = 0.0;
    double predicted = 0.0;
    Eigen::VectorXd usual_sigma = Eigen::VectorXd::Zero(model.tree.unknowns());
    Eigen::VectorXd predicted_sigma = usual_sigma;
    for (std::uint64_t frame = 0; frame < 8; ++frame) {
      const TiledCloud seen = cloud_of(measured(model, truth, "primesense", 7 + frame));
      const RegistrationResult whole = registration.align(
          seen, start, {.annealing_sigma = off, .iterations = 20, .narrowing = 6});
      const RegistrationResult& by_few = registration.align(
          seen, start, {.annealing_sigma = off, .iterations = 3, .is_predicted = true});
      usual += squared_errors(whole, truth);
      usual_sigma += whole.sigma_of_noise;
      predicted += squared_errors(by_few, truth);
      predicted_sigma += by_few.sigma_of_noise;
      EXPECT_TRUE(by_few.converged);
      EXPECT_EQ(by_few.last_move, 0.0);
      EXPECT_NEAR(by_few.explained_points, whole.explained_points, 0.01 * whole.explained_points);
    }
    EXPECT_LT(predicted, 1.2 * usual) << off;
    for (Eigen::Index i = 0; i < usual_sigma.size(); ++i) {
      EXPECT_NEAR(predicted_sigma[i], usual_sigma[i], 0.15 * usual_sigma[i]) << i << ", " << off;
    }
  }
}

/// The iteration that takes all points counts, and is reported, like the others.
TEST_F(AlignmentTest, FromAPredictionMakesNoMoreIterationsThanAllowed) {
  ArticulatedRegistration registration(model, {}, Executor(1));
  const TiledCloud seen = cloud_of(measured(model, truth, "primesense", 7));
  Configuration start = truth;
  start.q[0] += 0.012;
  for (const int iterations : {1, 2, 3}) {
    int reports = 0;
    const auto count = [&](const Configuration&, bool) { return ++reports > 0; };
    const RegistrationResult& found = registration.align(seen, start,
                                                         {.annealing_sigma = 0.005,
                                                          .iterations = iterations,
                                                          .is_predicted = true,
                                                          .on_iteration = count});
    EXPECT_EQ(found.iterations, iterations);
    EXPECT_EQ(reports, iterations);
  }
}

/// A short step leads to where what is left is a shorter one.
TEST_F(AlignmentTest, FromANearPredictionTakesTwoIterations) {
  const TiledCloud seen = cloud_of(measured(model, truth, "primesense", 7));
  for (const double off : {0.001, 0.0035}) {
    for (const std::size_t budget : {1000U, 20000U}) {
      Configuration start = truth;
      start.q[0] += off;
      RegistrationOptions options;
      options.point_budget = budget;
      ArticulatedRegistration registration(model, options, Executor(1));
      const RegistrationResult& found = registration.align(
          seen, start, {.annealing_sigma = 0.005, .iterations = 5, .is_predicted = true});
      EXPECT_EQ(found.iterations, 2) << off << " " << budget;
      EXPECT_TRUE(found.converged) << off << " " << budget;
      EXPECT_EQ(found.last_move, 0.0) << off << " " << budget;
    }
  }
}

TEST_F(AlignmentTest, FixedBaseAndLockedJointsDoNotMove) {
  RegistrationOptions options;
  options.fixed_base = true;
  options.locked = {false, true, false};
  ArticulatedRegistration registration(model, options, Executor(1));
  Configuration start = truth;
  start.q[0] += 0.004;
  start.q[1] += 0.02;
  const RegistrationResult& result = registration.align(cloud, start, {0.01, 10});
  EXPECT_EQ(result.configuration.T_camera_base.matrix(), start.T_camera_base.matrix());
  EXPECT_EQ(result.configuration.q[1], start.q[1]);
  EXPECT_NEAR(result.configuration.q[0], truth.q[0], 2e-3);
  EXPECT_EQ(result.sigma[0], 0.0);
}

TEST_F(AlignmentTest, LimitsAreNeverLeft) {
  Configuration at_limit = truth;
  at_limit.q[0] = 0.08;
  const TiledCloud seen = cloud_of(measured(model, at_limit, "primesense", 3));
  ArticulatedRegistration registration(model, {}, Executor(1));
  const RegistrationResult& result = registration.align(seen, at_limit, {0.005, 10});
  EXPECT_LE(result.configuration.q[0], 0.08);
  EXPECT_NEAR(result.configuration.q[0], 0.08, 2e-3);
}

TEST_F(AlignmentTest, AnEmptyCloudMovesNothingAndIsNotObservable) {
  DepthFrame nothing = measured(model, truth, "ideal");
  std::fill(nothing.depth.begin(), nothing.depth.end(), std::uint16_t{0});
  ArticulatedRegistration registration(model, {}, Executor(1));
  const RegistrationResult& result = registration.align(cloud_of(nothing), truth, {0.01, 5});
  EXPECT_EQ(result.configuration.T_camera_base.matrix(), truth.T_camera_base.matrix());
  for (const bool observable : result.observable) {
    EXPECT_FALSE(observable);
  }
  EXPECT_EQ(result.agreement.explained, 0.0);
}

}  // namespace
}  // namespace lockbox
