// SPDX-License-Identifier: BSD-3-Clause
// The consistency check: what of the visible surface an image explains, contradicts or hides.
#include "lockbox/verification/consistency_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "initialization/seen_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/view/predicted_view.hpp"
#include "lockbox/view/view_detail.hpp"

namespace lockbox {
namespace {

class ConsistencyCheckTest : public ::testing::Test {
 protected:
  /// Of the model as it is drawn there, with this image.
  void measure(const TiledCloud& cloud, const Configuration& configuration) {
    PredictedView view(0, view_detail(0));
    view.look_at(cloud, model_, configuration, 0.0, false, options_, executor_);
    BodyPoses poses;
    forward_kinematics(model_.tree, configuration, poses);
    check_.measure(model_, view.surface(), view.samples(), poses, cloud, options_, executor_,
                   [] {});
  }

  static double sum(const Agreement& agreement) {
    return agreement.explained + agreement.contradicted + agreement.occluded + agreement.unknown;
  }

  Configuration towards_camera(double metres) const {
    Configuration moved = truth_;
    moved.T_camera_base.pretranslate(Eigen::Vector3d(0.0, 0.0, -metres));
    return moved;
  }

  const ArticulatedModel& model_ = shipped("cabinet");
  const Configuration truth_ = *model_.parameters.initial_configuration;
  ViewOptions options_;
  Executor executor_{1};
  ConsistencyCheck check_;
};

TEST_F(ConsistencyCheckTest, WhatIsThereIsExplained) {
  measure(seen(model_, truth_, wall_behind(0.6)), truth_);
  EXPECT_GT(check_.total().explained, 0.9);
  EXPECT_LT(check_.total().contradicted, 0.02);
  EXPECT_GT(check_.total().precision(), 0.98);
  EXPECT_NEAR(sum(check_.total()), 1.0, 1e-9);
}

TEST_F(ConsistencyCheckTest, WhatTheCameraSawThroughIsContradicted) {
  const TiledCloud cloud = seen(model_, truth_, wall_behind(0.6));
  measure(cloud, towards_camera(0.15));
  EXPECT_GT(check_.total().contradicted, 0.8);
  EXPECT_LT(check_.total().explained, 0.1);
  EXPECT_LT(check_.total().score(), -1.0);
}

TEST_F(ConsistencyCheckTest, WhatLiesBehindTheMeasurementIsOccluded) {
  const TiledCloud cloud = seen(model_, truth_, wall_behind(0.6));
  measure(cloud, towards_camera(-0.15));
  EXPECT_GT(check_.total().occluded, 0.8);
  EXPECT_LT(check_.total().contradicted, 0.02);
}

TEST_F(ConsistencyCheckTest, WhatIsNotMeasuredIsUnknown) {
  DepthFrame frame = seen_frame(model_, truth_, wall_behind(0.6));
  std::fill(frame.depth.begin(), frame.depth.end(), std::uint16_t{0});
  TiledCloud cloud;
  cloud.assign(frame, {}, executor_);
  measure(cloud, truth_);
  EXPECT_EQ(check_.total().unknown, 1.0);
  EXPECT_EQ(check_.total().precision(), 0.0);
}

/// One drawer that is out while the image shows it in: the others are explained all the same.
TEST_F(ConsistencyCheckTest, ABodyIsCheckedByItself) {
  const TiledCloud cloud = seen(model_, truth_, wall_behind(0.6));
  Configuration pulled_out = truth_;
  int body = -1;
  for (const Joint& joint : model_.tree.joints) {
    if (joint.type != JointType::prismatic || body >= 0) continue;
    pulled_out.q[joint.variable] = joint.upper;
    body = joint.child_body;
  }
  ASSERT_GE(body, 0);
  measure(cloud, pulled_out);
  EXPECT_LT(check_.bodies()[static_cast<std::size_t>(body)].precision(), 0.2);
  EXPECT_GT(check_.bodies().front().precision(), 0.9);
}

/// A model in a bare wall explains every pixel, but the wall goes on around it.
TEST_F(ConsistencyCheckTest, AContourTellsWhetherTheSurfaceGoesOn) {
  measure(seen(model_, truth_, wall_behind(0.6)), truth_);
  EXPECT_GT(check_.contour().samples, 100);
  EXPECT_LT(check_.contour().continued(), 0.2);
}

}  // namespace
}  // namespace lockbox
