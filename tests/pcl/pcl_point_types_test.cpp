// SPDX-License-Identifier: BSD-3-Clause
// What the registration finds where PCL's programs have an ICP: with any point type.
#include "lockbox/pcl/articulated_sdf_registration.hpp"
#include "pcl_registration_fixture.hpp"

namespace lockbox {
namespace {

template <typename Types>
class PclPointTypesTest : public PclRegistrationTest {};

template <typename PointT, typename ScalarT>
struct Face {
  using Point = PointT;
  using Scalar = ScalarT;
};
using Faces = ::testing::Types<Face<pcl::PointXYZ, float>, Face<pcl::PointXYZ, double>,
                               Face<pcl::PointXYZI, double>, Face<pcl::PointXYZRGB, float>,
                               Face<pcl::PointXYZRGBA, double>, Face<pcl::PointNormal, float>,
                               Face<pcl::PointXYZRGBNormal, double>>;
TYPED_TEST_SUITE(PclPointTypesTest, Faces);

TYPED_TEST(PclPointTypesTest, FindsBaseAndJoints) {
  using Point = typename TypeParam::Point;
  using Scalar = typename TypeParam::Scalar;
  ArticulatedSdfRegistration<Point, Scalar> registration;
  this->prepare(registration);
  registration.setInputSource(converted<Point>(*this->scan));
  pcl::PointCloud<Point> aligned;
  registration.align(aligned, this->guess().template cast<Scalar>());
  EXPECT_TRUE(registration.hasConverged());
  this->expect_truth(registration.getFinalTransformation().template cast<double>(),
                     registration.getJointPositions());
  EXPECT_GT(registration.getExplainedShare(), 0.9);
  EXPECT_LT(registration.getContradictedShare(), 0.02);
}

}  // namespace
}  // namespace lockbox
