// SPDX-License-Identifier: BSD-3-Clause
// What a sixth of the points, chosen for what they tell, still says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lockbox/core/lie.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "mechanism.hpp"

namespace lockbox {
namespace {

constexpr int kSeeds = 20;

struct Outcome {
  Eigen::ArrayXd rmse;        ///< by unknown
  Eigen::ArrayXd normalised;  ///< mean squared error by reported variance
};

Outcome registered(std::size_t budget) {
  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  RegistrationOptions options;
  options.point_budget = budget;
  ArticulatedRegistration registration(model, options, Executor(1));
  const Eigen::Index unknowns = model.tree.unknowns();
  Outcome outcome{Eigen::ArrayXd::Zero(unknowns), Eigen::ArrayXd::Zero(unknowns)};
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const TiledCloud cloud = cloud_of(measured(model, truth, "primesense", seed));
    const RegistrationResult& result = registration.align(cloud, truth, {0.003, 10});
    Eigen::ArrayXd error(unknowns);
    error << log_se3(truth.T_camera_base.inverse() * result.configuration.T_camera_base),
        result.configuration.q - truth.q;
    outcome.rmse += error.square() / kSeeds;
    outcome.normalised += (error / result.sigma_of_noise.array()).square() / kSeeds;
  }
  outcome.rmse = outcome.rmse.sqrt();
  return outcome;
}

// The board's in-plane axes lose most, two to three times: where a point of a plane stands for 64
// pixels, the error of its normal no longer averages out. (docs/benchmarks.md has the shipped
// lockbox.)
TEST(PointBudget, ASixthOfThePointsErrsAFewTimesAsMuchAtMost) {
  const Outcome all = registered(0);
  const Outcome some = registered(4000);
  // What no number of points averages away: 0.05 mm, 0.005 degrees and 0.15 mm or so of joints.
  for (Eigen::Index i = 0; i < all.rmse.size(); ++i) {
    const double floor = i < 3 ? 1e-4 : (i < kBaseUnknowns ? 2e-4 : 5e-4);
    EXPECT_LT(some.rmse[i], 3.5 * all.rmse[i] + floor) << "unknown " << i;
  }
}

TEST(PointBudget, TheCovarianceKnowsOfIt) {
  const Outcome some = registered(2000);
  EXPECT_LT(some.normalised.maxCoeff(), 9.0);
  EXPECT_GT(some.normalised.mean(), 0.1);
  EXPECT_LT(some.normalised.mean(), 3.0);
}

TEST(PointBudget, OfAtLeastAllPointsIsAllPointsOfTheObject) {
  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  const TiledCloud cloud = cloud_of(measured(model, truth, "primesense", 1));
  RegistrationOptions options;
  options.point_budget = 0;
  const double all = ArticulatedRegistration(model, options, Executor(1))
                         .align(cloud, truth, {0.003, 3})
                         .explained_points;
  options.point_budget = cloud.depth().size();
  const double budgeted = ArticulatedRegistration(model, options, Executor(1))
                              .align(cloud, truth, {0.003, 3})
                              .explained_points;
  EXPECT_NEAR(budgeted / all, 1.0, 1e-3);
}

}  // namespace
}  // namespace lockbox
