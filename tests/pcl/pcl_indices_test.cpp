// SPDX-License-Identifier: BSD-3-Clause
// Indices that do not belong to the source (any more) do not end the process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "pcl_registration_fixture.hpp"

namespace lockbox {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class PclIndicesTest : public PclRegistrationTest {
 protected:
  PclIndicesTest() { prepare(registration); }

  static pcl::IndicesPtr selection(const pcl::Indices& points) {
    return pcl::make_shared<pcl::Indices>(points);
  }

  /// Of every fourth row and column; not an image of which the camera could not be told.
  Cloud::Ptr smaller() const {
    const auto small = pcl::make_shared<Cloud>(scan->width / 4, scan->height / 4);
    const auto width = static_cast<int>(small->width);
    const auto height = static_cast<int>(small->height);
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) small->at(u, v) = scan->at(4 * u, 4 * v);
    }
    return small;
  }

  pcl::IndicesPtr all_of(const Cloud& cloud) const {
    const auto all = selection(pcl::Indices(cloud.size()));
    for (std::size_t i = 0; i < all->size(); ++i) (*all)[i] = static_cast<pcl::index_t>(i);
    return all;
  }

  std::string printed_by_align() {
    ::testing::internal::CaptureStderr();
    ::testing::internal::CaptureStdout();
    base().align(aligned, guess());
    return ::testing::internal::GetCapturedStdout() + ::testing::internal::GetCapturedStderr();
  }

  void expect_refused() {
    registration.setJointPositions(joints_off());
    EXPECT_THAT(printed_by_align(), HasSubstr("setIndices"));
    EXPECT_FALSE(registration.hasConverged());
    EXPECT_EQ(registration.getJointPositions(), joints_off());
    EXPECT_EQ(aligned.size(), registration.getInputSource()->size());
  }

  void expect_aligned() {
    registration.setJointPositions(joints_off());
    EXPECT_THAT(printed_by_align(), Not(HasSubstr("setIndices")));
    expect_truth(registration);
  }

  /// As generic programs call it.
  pcl::Registration<pcl::PointXYZ, pcl::PointXYZ>& base() { return registration; }

  Registration registration;
  Cloud aligned;
};

TEST_F(PclIndicesTest, OfALargerCloudBeforeAreRefusedUntilTheyFit) {
  registration.setInputSource(scan);
  base().setIndices(all_of(*scan));
  expect_aligned();
  base().setInputSource(smaller());
  expect_refused();
  base().setInputSource(scan);
  expect_aligned();
}

TEST_F(PclIndicesTest, OfPointsThatDoNotExistAreRefused) {
  registration.setInputSource(scan);
  const auto size = static_cast<pcl::index_t>(scan->size());
  for (const pcl::index_t wrong : {-1, size, std::numeric_limits<pcl::index_t>::max(),
                                   std::numeric_limits<pcl::index_t>::min()}) {
    const pcl::IndicesPtr indices = all_of(*scan);
    indices->back() = wrong;
    base().setIndices(indices);
    expect_refused();
  }
  base().setIndices(pcl::IndicesPtr());
  expect_aligned();
}

TEST_F(PclIndicesTest, MayBeLeftEmpty) {
  registration.setInputSource(scan);
  base().setIndices(selection({}));
  base().align(aligned, guess());
  EXPECT_FALSE(registration.hasConverged());
}

TEST_F(PclIndicesTest, OfNullMeanAllPoints) {
  registration.setInputSource(scan);
  const std::function<void()> forget[] = {
      [this] { base().setIndices(pcl::IndicesPtr()); },
      [this] { base().setIndices(pcl::IndicesConstPtr()); },
      [this] { base().setIndices(pcl::PointIndices::ConstPtr()); }};
  for (const auto& forget_indices : forget) {
    base().setIndices(selection({-1}));
    forget_indices();
    EXPECT_EQ(registration.getIndices(), nullptr);
    expect_aligned();
  }
}

TEST_F(PclIndicesTest, OfEveryKindAreFollowed) {
  registration.setInputSource(scan);
  const auto of_points = pcl::make_shared<pcl::PointIndices>();
  of_points->indices = {3, 5};
  base().setIndices(pcl::PointIndices::ConstPtr(of_points));
  EXPECT_EQ(*registration.getIndices(), of_points->indices);
  base().setIndices(pcl::IndicesConstPtr(selection({7})));
  EXPECT_EQ(*registration.getIndices(), pcl::Indices{7});
  base().setIndices(1, 2, 1, 2);
  const auto width = static_cast<pcl::index_t>(scan->width);
  EXPECT_EQ(*registration.getIndices(), (pcl::Indices{width + 2, width + 3}));
}

TEST_F(PclIndicesTest, OfARegionBeyondTheCloudChangeNothing) {
  registration.setInputSource(scan);
  base().setIndices(selection({7}));
  base().setIndices(0, 0, scan->height + 1, 1);
  EXPECT_EQ(*registration.getIndices(), pcl::Indices{7});
}

TEST_F(PclIndicesTest, ChangedAfterTheyWereGivenAreLookedAtAnew) {
  registration.setInputSource(scan);
  const pcl::IndicesPtr indices = all_of(*scan);
  base().setIndices(indices);
  indices->push_back(static_cast<pcl::index_t>(scan->size()));
  expect_refused();
}

TEST_F(PclIndicesTest, OfACloudThatShrankAreRefused) {
  const auto shrinking = pcl::make_shared<Cloud>(*scan);
  base().setInputSource(shrinking);
  base().setIndices(all_of(*scan));
  shrinking->resize(scan->size() / 2);
  expect_refused();
  shrinking->clear();
  expect_refused();
}

TEST_F(PclIndicesTest, BeforeAnySourceAreKeptForIt) {
  base().setIndices(all_of(*scan));
  base().align(aligned, guess());
  EXPECT_FALSE(registration.hasConverged());
  base().setInputSource(scan);
  expect_aligned();
}

TEST_F(PclIndicesTest, AreFollowedWhenTheSourceIsAlsoTheOutput) {
  const auto moving = pcl::make_shared<Cloud>(*scan);
  base().setInputSource(moving);
  base().setIndices(all_of(*smaller()));  // fewer than there are points
  base().align(*moving, guess());
  EXPECT_EQ(moving->size(), scan->size());

  *moving = *scan;
  base().setIndices(all_of(*scan));
  registration.setJointPositions(joints_off());
  base().align(*moving, guess());
  expect_truth(registration);
  EXPECT_EQ(moving->size(), scan->size());
}

TEST_F(PclIndicesTest, ANullCloudIsAnEmptyOne) {
  for (const Cloud::Ptr& nothing : {Cloud::Ptr(), pcl::make_shared<Cloud>()}) {
    base().setInputSource(scan);
    static_cast<pcl::PCLBase<pcl::PointXYZ>&>(registration).setInputCloud(nothing);
    base().align(aligned, guess());
    EXPECT_FALSE(registration.hasConverged());
    EXPECT_EQ(registration.getFitnessScore(), std::numeric_limits<double>::max());
  }
}

TEST_F(PclIndicesTest, ACloudMayHaveLostItsRows) {
  const auto list = pcl::make_shared<Cloud>(*scan);
  list->points.resize(scan->size() - 100);  // width and height still say otherwise
  base().setInputSource(list);
  base().align(aligned, guess());
  EXPECT_TRUE(registration.hasConverged());
}

}  // namespace
}  // namespace lockbox
