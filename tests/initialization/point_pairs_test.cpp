// SPDX-License-Identifier: BSD-3-Clause
#include "point_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/free_form_object.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "point_match.hpp"

namespace lockbox {
namespace {

const PinholeCamera kSmallCamera{320, 240, 287.9, 287.9, 159.5, 119.5};

/// An animal, which looks like itself in no other pose.
KinematicTree animal() {
  KinematicTree tree;
  tree.bodies.emplace_back().mesh = draw_free_form(ObjectBlock("tune"), 1).links.front().mesh;
  return tree;
}

Eigen::Isometry3d turned_pose() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 0.05, -0.03, 0.7;
  pose.linear() = (Eigen::AngleAxisd(2.0, Eigen::Vector3d(1.0, 0.3, -0.2).normalized()) *
                   Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()))
                      .toRotationMatrix();
  return pose;
}

std::vector<float> drawn_depth(const KinematicTree& tree, const Eigen::Isometry3d& pose) {
  DepthRenderer renderer(kSmallCamera, Executor(1));
  RenderedDepth image;
  const std::vector<RenderItem> items{body_item(tree, 0, pose)};
  renderer.render(items, image);
  std::replace_if(
      image.depth.begin(), image.depth.end(), [](float z) { return !std::isfinite(z); }, 0.0F);
  return image.depth;
}

bool is_near(const PoseVote& vote, const Eigen::Isometry3d& truth, double metres, double radians) {
  const Eigen::Isometry3d error = vote.T_camera_body.inverse() * truth;
  return error.translation().norm() < metres && Eigen::AngleAxisd(error.linear()).angle() < radians;
}

TEST(OrientedPoints, OfABodyLieOnItsSurfaceAndFaceOutwards) {
  KinematicTree tree;
  constexpr double kRadius = 0.1;
  tree.bodies.emplace_back().mesh = make_sphere(kRadius);
  const auto points = points_of_body(tree, 0, 0.02, Executor(1));
  // A point takes about as much surface as a square of the spacing.
  EXPECT_GT(points.size(), 150U);
  EXPECT_LT(points.size(), 700U);
  for (const OrientedPoint& point : points) {
    EXPECT_NEAR(point.position.norm(), kRadius, 0.003);
    EXPECT_GT(point.normal.dot(point.position.normalized()), 0.97F);
  }
}

TEST(OrientedPoints, OfAPlaneHaveItsNormal) {
  const Eigen::Vector3d m(0.3, -0.2, 1.0);  // of the plane m.p = 1
  std::vector<float> depth;
  for (int v = 0; v < kSmallCamera.height; ++v) {
    for (int u = 0; u < kSmallCamera.width; ++u) {
      depth.push_back(static_cast<float>(1.0 / m.dot(kSmallCamera.back_project(u, v, 1.0))));
    }
  }
  const auto points = points_of_view({kSmallCamera, depth}, 0.03);
  ASSERT_FALSE(points.empty());
  for (const OrientedPoint& point : points) {
    EXPECT_GT(point.normal.dot(-m.normalized().cast<float>()), 0.9999F);
    EXPECT_NEAR(m.dot(point.position.cast<double>()), 1.0, 1e-4);
  }
}

TEST(PointPairs, VoteForWhereTheBodyIs) {
  const KinematicTree tree = animal();
  const BodyPairs body = make_body_pairs(tree, telling_bodies(tree).front(), Executor(1));
  const Eigen::Isometry3d truth = turned_pose();
  const auto depth = drawn_depth(tree, truth);
  const auto points = points_of_view({kSmallCamera, depth}, body.pairs.spacing());
  const auto votes = body.pairs.vote(points, 20, Executor(1), nullptr);
  ASSERT_FALSE(votes.empty());
  EXPECT_TRUE(is_near(votes.front(), truth, 0.03, 20.0 * kRadians));
  for (std::size_t i = 1; i < votes.size(); ++i) EXPECT_LE(votes[i].votes, votes[i - 1].votes);
}

TEST(PointPairs, VoteTheSameWithAnyNumberOfThreads) {
  const KinematicTree tree = animal();
  const BodyPairs body = make_body_pairs(tree, telling_bodies(tree).front(), Executor(1));
  const auto depth = drawn_depth(tree, turned_pose());
  const auto points = points_of_view({kSmallCamera, depth}, body.pairs.spacing());
  const auto one = body.pairs.vote(points, 20, Executor(1), nullptr);
  const auto two = body.pairs.vote(points, 20, Executor(2), nullptr);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].votes, two[i].votes);
    EXPECT_EQ(one[i].T_camera_body.matrix(), two[i].T_camera_body.matrix());
  }
}

TEST(PointPairs, StopWhenTheyAreAskedTo) {
  const KinematicTree tree = animal();
  const BodyPairs body = make_body_pairs(tree, telling_bodies(tree).front(), Executor(1));
  const auto depth = drawn_depth(tree, turned_pose());
  const auto points = points_of_view({kSmallCamera, depth}, body.pairs.spacing());
  EXPECT_THROW(body.pairs.vote(points, 20, Executor(1), [] { return true; }), Stopped);
}

TEST(PointPairs, VoteForNothingWhereNothingIsSeen) {
  const BodyPairs body = make_body_pairs(animal(), 0, Executor(1));
  EXPECT_TRUE(body.pairs.vote({}, 20, Executor(1), nullptr).empty());
}

}  // namespace
}  // namespace lockbox
