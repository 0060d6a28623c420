// SPDX-License-Identifier: BSD-3-Clause
// PCL's contract: what a program may expect of any pcl::Registration, and what PCL leaves to the
// end of the process.
#include <gmock/gmock.h>
#include <pcl/common/transforms.h>

#include <limits>

#include "pcl_registration_fixture.hpp"

namespace lockbox {
namespace {

using ::testing::HasSubstr;

class PclContractTest : public PclRegistrationTest {
 protected:
  using Criteria = Registration::ConvergenceCriteria;

  PclContractTest() {
    prepare(registration);
    registration.setInputSource(scan);
  }

  Criteria::ConvergenceState state() const {
    return registration.getConvergeCriteria()->getConvergenceState();
  }

  /// Aligns from the given start, and returns how many iterations it took.
  int iterations(const Eigen::Matrix4f& start) {
    int count = -1;  // the registration of the callback calls it once
    std::function<Registration::UpdateVisualizerCallbackSignature> counter =
        [&count](const auto&, const auto&, const auto&, const auto&) { ++count; };
    registration.registerVisualizationCallback(counter);
    registration.setJointPositions(joints_off());
    registration.align(aligned, start);
    return count;
  }

  std::string printed_by_align() {
    ::testing::internal::CaptureStderr();
    ::testing::internal::CaptureStdout();
    registration.align(aligned, guess());
    return ::testing::internal::GetCapturedStdout() + ::testing::internal::GetCapturedStderr();
  }

  Registration registration;
  Cloud aligned;
};

TEST_F(PclContractTest, WorksThroughAPointerToTheBase) {
  pcl::Registration<pcl::PointXYZ, pcl::PointXYZ>* const base = &registration;
  base->setInputTarget(scan);  // as generic programs do; the model stays the target
  base->align(aligned, guess());
  EXPECT_TRUE(base->hasConverged());
  expect_truth(registration);
  EXPECT_LT(base->getFitnessScore(1e-3), 1e-4);
  EXPECT_EQ(base->getClassName(), "ArticulatedSdfRegistration");
}

TEST_F(PclContractTest, TheOutputIsTheWholeSourceMoved) {
  scan->header.frame_id = "camera";
  scan->header.stamp = 17;
  registration.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{1000, 2000}));
  registration.align(aligned, guess());
  ASSERT_EQ(aligned.width, scan->width);
  ASSERT_EQ(aligned.height, scan->height);
  EXPECT_EQ(aligned.header.frame_id, "camera");
  EXPECT_EQ(aligned.header.stamp, 17U);
  Cloud moved;
  pcl::transformPointCloud(*scan, moved, registration.getFinalTransformation());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    ASSERT_EQ(std::isfinite(aligned[i].z), std::isfinite((*scan)[i].z));
    if (std::isfinite(moved[i].z)) {
      ASSERT_EQ(aligned[i].getVector3fMap(), moved[i].getVector3fMap());
    }
  }
}

TEST_F(PclContractTest, NormalsTurnWithTheirPoints) {
  ArticulatedSdfRegistration<pcl::PointNormal> with_normals;
  prepare(with_normals);
  const auto source = converted<pcl::PointNormal>(*scan);
  for (pcl::PointNormal& point : *source) {
    point.getNormalVector3fMap() = Eigen::Vector3f(0.6F, 0.0F, -0.8F);
  }
  with_normals.setInputSource(source);
  pcl::PointCloud<pcl::PointNormal> output;
  with_normals.align(output, guess());
  const Eigen::Vector3f turned = with_normals.getFinalTransformation().topLeftCorner<3, 3>() *
                                 Eigen::Vector3f(0.6F, 0.0F, -0.8F);
  const std::size_t middle = output.size() / 2 + output.width / 2;
  EXPECT_LT((output[middle].getNormalVector3fMap() - turned).norm(), 1e-5F);
}

TEST_F(PclContractTest, TheTargetIsTheModelWithTheJointsThatWereFound) {
  const auto before = registration.getInputTarget();
  registration.align(aligned, guess());
  const double fitness = registration.getFitnessScore(1e-3);
  EXPECT_NE(registration.getInputTarget(), before);
  EXPECT_EQ(registration.getInputTarget()->size(), before->size());
  registration.setJointPosition("turn", registration.getJointPosition("turn") + 0.5);
  EXPECT_GT(registration.getFitnessScore(1e-3), 1.2 * fitness);
}

TEST_F(PclContractTest, ReachingTheLastIterationCountsAsConverged) {
  registration.setMaximumIterations(4);
  EXPECT_EQ(iterations(guess()), 4);
  EXPECT_TRUE(registration.hasConverged());
  EXPECT_EQ(state(), Criteria::CONVERGENCE_CRITERIA_ITERATIONS);
}

TEST_F(PclContractTest, TheTransformationEpsilonEndsItEarlier) {
  registration.setMaximumIterations(60);
  registration.setTransformationEpsilon(1e-6);  // a millimetre, squared
  EXPECT_LT(iterations(guess()), 40);
  EXPECT_TRUE(registration.hasConverged());
  EXPECT_EQ(state(), Criteria::CONVERGENCE_CRITERIA_TRANSFORM);
  expect_truth(registration);
}

TEST_F(PclContractTest, TheFitnessEpsilonEndsItEarlier) {
  registration.setMaximumIterations(6);  // so few that it still moves within narrow gates
  const int without = iterations(guess());
  registration.setEuclideanFitnessEpsilon(0.01);  // of the mean squared error
  EXPECT_LT(iterations(guess()), without);
  EXPECT_TRUE(registration.hasConverged());
  // At rest the error does not change at all, which PCL tells from changing little.
  EXPECT_TRUE(state() == Criteria::CONVERGENCE_CRITERIA_REL_MSE ||
              state() == Criteria::CONVERGENCE_CRITERIA_ABS_MSE);
  expect_truth(registration);
}

TEST_F(PclContractTest, ASecondAlignmentDoesNotRememberTheFirst) {
  registration.setEuclideanFitnessEpsilon(0.01);
  registration.setMaximumIterations(60);
  const int first = iterations(guess());
  const Eigen::Matrix4f found = registration.getFinalTransformation();
  EXPECT_EQ(iterations(guess()), first);
  EXPECT_EQ(registration.getFinalTransformation(), found);
}

TEST_F(PclContractTest, PointsBeyondTheMaximumCorrespondenceDistanceAreNotMatched) {
  Eigen::Isometry3f away = Eigen::Isometry3f::Identity();
  away.translation().z() = 0.2F;  // towards the camera, where nothing is
  const Eigen::Matrix4f start = away.matrix() * guess();
  registration.setMaxCorrespondenceDistance(0.05);
  registration.align(aligned, start);
  EXPECT_FALSE(registration.hasConverged());
  EXPECT_EQ(state(), Criteria::CONVERGENCE_CRITERIA_NO_CORRESPONDENCES);
  EXPECT_EQ(registration.getFinalTransformation(), start);
  EXPECT_EQ(registration.getJointPositions(), joints_off());
  EXPECT_EQ(aligned.size(), scan->size());
}

TEST_F(PclContractTest, TheVisualizationSeesEachIteration) {
  int calls = 0;
  std::function<Registration::UpdateVisualizerCallbackSignature> callback =
      [&](const Cloud& moved, const pcl::Indices& points, const Cloud& target,
          const pcl::Indices& samples) {
        ++calls;
        EXPECT_EQ(moved.size(), scan->size());
        ASSERT_EQ(points.size(), samples.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
          const Eigen::Vector3f p = moved.at(static_cast<std::size_t>(points[i])).getVector3fMap();
          const Eigen::Vector3f q =
              target.at(static_cast<std::size_t>(samples[i])).getVector3fMap();
          EXPECT_LT((p - q).norm(), 0.06F + 0.01F);  // the distance, and between samples
        }
      };
  ASSERT_TRUE(registration.registerVisualizationCallback(callback));
  EXPECT_EQ(calls, 1);
  registration.setMaximumIterations(3);
  registration.align(aligned, guess());
  EXPECT_EQ(calls, 1 + 3);
}

TEST_F(PclContractTest, ACallbackMayComeBeforeTheClouds) {
  Registration fresh;
  int calls = 0;
  std::function<Registration::UpdateVisualizerCallbackSignature> callback =
      [&calls](const auto&, const auto&, const auto&, const auto&) { ++calls; };
  EXPECT_TRUE(fresh.registerVisualizationCallback(callback));
  EXPECT_EQ(calls, 1);
}

TEST_F(PclContractTest, AnEmptyCloudDoesNotConvergeAndLeavesTheJoints) {
  registration.align(aligned, guess());
  const Eigen::VectorXd found = registration.getJointPositions();
  registration.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{1000, 2000}));
  for (const Cloud::Ptr& nothing : {pcl::make_shared<Cloud>(), Cloud::Ptr()}) {
    registration.setInputSource(nothing);
    registration.align(aligned, guess());
    EXPECT_FALSE(registration.hasConverged());
    EXPECT_TRUE(aligned.empty());
    EXPECT_EQ(registration.getJointPositions(), found);
    EXPECT_EQ(registration.getFitnessScore(), std::numeric_limits<double>::max());
  }
  registration.setInputSource(scan);
  registration.setJointPositions(joints_off());
  registration.align(aligned, guess());
  expect_truth(registration);
}

TEST_F(PclContractTest, ACloudWithoutAFinitePointDoesNotConverge) {
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  registration.setInputSource(
      pcl::make_shared<Cloud>(64, 48, pcl::PointXYZ(unknown, unknown, unknown)));
  registration.align(aligned, guess());
  EXPECT_FALSE(registration.hasConverged());
  EXPECT_EQ(aligned.size(), 64U * 48U);
  EXPECT_EQ(registration.getFitnessScore(), std::numeric_limits<double>::max());
}

TEST_F(PclContractTest, WithoutAModelOrASourceNothingConverges) {
  Registration without_model;
  without_model.setInputSource(scan);
  without_model.align(aligned, guess());
  EXPECT_FALSE(without_model.hasConverged());
  Registration without_source;
  prepare(without_source);
  without_source.align(aligned, guess());
  EXPECT_FALSE(without_source.hasConverged());
}

TEST_F(PclContractTest, AGuessMustBeARigidMotion) {
  Eigen::Matrix4f unknown = guess();
  unknown(0, 0) = std::numeric_limits<float>::quiet_NaN();
  Eigen::Matrix4f stretched = guess();
  stretched.topLeftCorner<3, 3>() *= 1.2F;
  Eigen::Matrix4f mirrored = guess();
  mirrored.topLeftCorner<3, 1>() *= -1.0F;
  for (const Eigen::Matrix4f& wrong : {unknown, stretched, mirrored}) {
    registration.align(aligned, wrong);
    EXPECT_FALSE(registration.hasConverged());
    EXPECT_EQ(registration.getFinalTransformation(), Eigen::Matrix4f::Identity());
    EXPECT_EQ(registration.getJointPositions(), joints_off());
  }
}

TEST_F(PclContractTest, WarnsOnceOfWhatHasNoMeaning) {
  EXPECT_EQ(printed_by_align(), "");
  registration.setRANSACIterations(5);
  registration.setPointRepresentation(
      pcl::make_shared<pcl::DefaultPointRepresentation<pcl::PointXYZ>>());
  const std::string first = printed_by_align();
  EXPECT_THAT(first, HasSubstr("setRANSACIterations"));
  EXPECT_THAT(first, HasSubstr("setPointRepresentation"));
  EXPECT_EQ(printed_by_align(), "");
}

TEST_F(PclContractTest, AnotherSearchTreeIsNotUsed) {
  registration.setSearchMethodTarget(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>(), true);
  EXPECT_THAT(printed_by_align(), HasSubstr("setSearchMethodTarget"));
  (*scan)[0].x = std::numeric_limits<float>::quiet_NaN();  // would end the process in PCL's own
  EXPECT_LT(registration.getFitnessScore(1e-3), 1e-4);
}

TEST_F(PclContractTest, ANullSearchTreeIsRefused) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  registration.setSearchMethodTarget(nullptr);
  registration.setSearchMethodSource(nullptr, true);
  const std::string said =
      ::testing::internal::GetCapturedStdout() + ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, HasSubstr("setSearchMethodTarget"));
  EXPECT_THAT(said, HasSubstr("setSearchMethodSource"));
  EXPECT_NE(registration.getSearchMethodTarget(), nullptr);
  EXPECT_EQ(printed_by_align(), "");
  EXPECT_TRUE(registration.hasConverged());
  EXPECT_LT(registration.getFitnessScore(1e-3), 1e-4);
}

TEST_F(PclContractTest, ANullSearchTreeGivenToTheBaseIsMendedWithTheNextSourceOrModel) {
  Registration::Base& base = registration;
  base.setSearchMethodTarget(nullptr, true);
  registration.setInputSource(scan);
  EXPECT_NE(registration.getSearchMethodTarget(), nullptr);
  base.setSearchMethodTarget(nullptr);
  registration.setJointPositions(joints_off());
  EXPECT_NE(registration.getSearchMethodTarget(), nullptr);
  registration.align(aligned, guess());
  EXPECT_TRUE(registration.hasConverged());
}

/// One that PCL is told never to fill: nothing but the alignment itself follows it.
TEST_F(PclContractTest, ANullSearchTreeThatIsNotToBeFilledEndsNoAlignment) {
  Registration::Base& base = registration;
  base.setSearchMethodTarget(nullptr, true);
  base.setSearchMethodSource(nullptr, true);
  base.align(aligned, guess());
  EXPECT_TRUE(registration.hasConverged());
  EXPECT_LT(base.getFitnessScore(1e-3), 1e-4);
}

}  // namespace
}  // namespace lockbox
