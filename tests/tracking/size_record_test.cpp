// SPDX-License-Identifier: BSD-3-Clause
// How large an object looks over some time, and what may be the cause.
#include "lockbox/tracking/size_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lockbox {
namespace {

SizeMeasurement measurement(double across, double along, double sigma) {
  return {{across, along}, sigma * sigma * Eigen::Matrix2d::Identity(), {}};
}

ApparentSize apparent(double across, double along, double sigma_across, double sigma_along) {
  ApparentSize size;
  size.value = {across, along};
  size.covariance =
      Eigen::Vector2d(sigma_across * sigma_across, sigma_along * sigma_along).asDiagonal();
  return size;
}

TEST(SizeRecord, IsLessSureOfFewMeasurementsThanTheySay) {
  SizeRecord record;
  EXPECT_FALSE(record.mean().covariance.allFinite());
  EXPECT_FALSE(record.mean().is_implausible());
  record.add(measurement(1.05, 1.05, 0.001));
  record.add(measurement(1.05, 1.05, 0.001));
  EXPECT_FALSE(record.mean().is_implausible());
  record.add(measurement(1.05, 1.05, 0.001));
  EXPECT_TRUE(record.mean().is_implausible());
}

TEST(SizeRecord, KnowsFromOneMeasurementWhatIsATenthTooLarge) {
  SizeRecord record;
  record.add(measurement(1.1, 1.1, 0.005));
  EXPECT_TRUE(record.mean().is_implausible());
}

TEST(SizeRecord, MakesAnswersLessSureByWhatIsMoreThanChance) {
  RegistrationResult aligned;
  aligned.covariance = 1e-6 * Eigen::MatrixXd::Identity(7, 7);
  aligned.sigma = Eigen::VectorXd::Constant(7, 1e-3);
  SizeRecord record;
  record.add_misfit(aligned);
  EXPECT_EQ(aligned.sigma, Eigen::VectorXd::Constant(7, 1e-3)) << "nothing was measured";
  SizeMeasurement size = measurement(1.02, 1.02, 0.002);
  size.effect.setZero(7, 2);
  size.effect(6, 0) = 0.3;  // metres for a size of 1: 6 mm for 2 %, and half as much again
  for (int i = 0; i < 4; ++i) record.add(size);
  record.add_misfit(aligned);
  EXPECT_NEAR(aligned.sigma[6], std::hypot(0.001, 0.0088), 3e-4);
  EXPECT_NEAR(aligned.sigma[0], 1e-3, 1e-9);
  size.value = {1.002, 1.001};  // less than its standard deviation
  for (int i = 0; i < 6; ++i) record.add(size);
  aligned.covariance = 1e-6 * Eigen::MatrixXd::Identity(7, 7);
  record.add_misfit(aligned);
  EXPECT_NEAR(aligned.sigma[6], 1e-3, 1e-9);
}

TEST(SizeRecord, IsNotSurerForErrorsThatRepeat) {
  SizeRecord record;
  for (int i = 0; i < 40; ++i) record.add(measurement(1.02, 1.0, 0.004));
  EXPECT_NEAR(record.mean().value[0], 1.02, 1e-12);
  EXPECT_NEAR(std::sqrt(record.mean().covariance(0, 0)), 0.004, 1e-9);
}

TEST(SizeRecord, WeighsByPrecisionAndIsLessSureWhereMeasurementsDisagree) {
  SizeRecord record;
  record.add(measurement(1.00, 1.0, 0.001));
  record.add(measurement(1.10, 1.0, 0.1));
  record.add(measurement(1.00, 1.0, 0.001));
  EXPECT_NEAR(record.mean().value[0], 1.0, 1e-4);
  for (const double off : {0.03, -0.03, 0.03, -0.03, 0.03, -0.03}) {
    record.add(measurement(1.0 + off, 1.0, 0.001));
  }
  EXPECT_NEAR(record.mean().value[0], 1.0, 1e-9);
  EXPECT_GT(std::sqrt(record.mean().covariance(0, 0)), 0.01);
}

TEST(SizeRecord, ForgetsWhatIsLongAgo) {
  SizeRecord record;
  for (int i = 0; i < 6; ++i) record.add(measurement(1.1, 1.0, 0.001));
  for (int i = 0; i < 6; ++i) record.add(measurement(1.0, 1.0, 0.001));
  EXPECT_NEAR(record.mean().value[0], 1.0, 1e-12);
}

TEST(ApparentSize, IsImplausibleBeyondDoubtOnly) {
  EXPECT_TRUE(apparent(1.05, 1.0, 0.005, 0.01).is_implausible());
  EXPECT_TRUE(apparent(0.95, 1.0, 0.005, 0.01).is_implausible());
  EXPECT_FALSE(apparent(1.05, 1.0, 0.02, 0.01).is_implausible());
  EXPECT_FALSE(apparent(0.98, 0.9, 0.001, 0.01).is_implausible());
}

TEST(ApparentSize, LeavesOutTheCauseThatReliefRulesOut) {
  const ApparentSize larger = apparent(1.05, 1.05, 0.002, 0.005);
  EXPECT_TRUE(larger.may_be_scale());
  EXPECT_FALSE(larger.may_be_focal_length());
  const ApparentSize wider = apparent(0.95, 1.0, 0.002, 0.005);
  EXPECT_FALSE(wider.may_be_scale());
  EXPECT_TRUE(wider.may_be_focal_length());
  const ApparentSize flat = apparent(1.05, 1.02, 0.002, 0.05);
  EXPECT_TRUE(flat.may_be_scale());
  EXPECT_TRUE(flat.may_be_focal_length());
  const ApparentSize neither = apparent(1.05, 0.9, 0.002, 0.005);
  EXPECT_TRUE(neither.may_be_scale());
  EXPECT_TRUE(neither.may_be_focal_length());
}

}  // namespace
}  // namespace lockbox
