// SPDX-License-Identifier: BSD-3-Clause
// An answer whose door is right and whose carcass is not: the carcass is sought about the door.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base_scan.hpp"
#include "exact_fit.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "search_image.hpp"
#include "seen_model.hpp"

namespace lockbox {
namespace {

/// Radians by which the answer's door is open too far, its leaf where it is.
class BaseScan : public ::testing::TestWithParam<double> {
 protected:
  BaseScan() {
    truth_.q[door_.variable] = 0.7;
    cloud_ = seen(model_, truth_, wall_behind(0.6));
    image_.look_at(cloud_);
  }

  Configuration swung(double radians) const {
    const auto body = static_cast<std::size_t>(door_.child_body);
    std::vector<Eigen::Isometry3d> right;
    std::vector<Eigen::Isometry3d> wrong;
    Configuration answer = truth_;
    answer.q[door_.variable] += radians;
    forward_kinematics(model_.tree, truth_, right);
    forward_kinematics(model_.tree, answer, wrong);
    answer.T_camera_base = right[body] * wrong[body].inverse() * answer.T_camera_base;
    return answer;
  }
  double radians_off(const Configuration& found) const {
    return log_so3(found.T_camera_base.linear().transpose() * truth_.T_camera_base.linear()).norm();
  }

  const ArticulatedModel& model_ = shipped("cabinet");
  const Joint& door_ = *std::find_if(model_.tree.joints.begin(), model_.tree.joints.end(),
                                     [](const Joint& joint) { return joint.name == "door"; });
  const Configuration held_ = rest_configuration(model_.tree);
  Configuration truth_ = facing(model_, 1.1, 0.4, 0.1);
  TiledCloud cloud_;
  const InitializerOptions options_;
  const Executor executor_{1};
  const SoughtModel sought_{model_, options_.registration};
  const ViewNoise noise_{options_.registration.noise.sigma_inverse_depth()};
  SearchImage image_{sought_, noise_, nullptr, executor_};
  ExactFit exact_{model_, options_, executor_};
};

TEST_P(BaseScan, FindsTheCarcassOfADoorThatIsRight) {
  const Configuration answer = swung(GetParam());
  ASSERT_GT(radians_off(answer), 0.9 * std::abs(GetParam()));
  const auto found = with_base_swung(image_, sought_, held_, answer,
                                     exact_.compare(cloud_, answer).body_agreement, executor_);
  const auto is_right = [&](const Hypothesis& hypothesis) {
    return radians_off(hypothesis.configuration) < 0.07;  // a step of its range and less
  };
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), is_right));
  EXPECT_LT(found.size(), 20U);
}

INSTANTIATE_TEST_SUITE_P(Radians, BaseScan, ::testing::Values(-0.5, -0.26, 0.26, 0.5, 1.0));

}  // namespace
}  // namespace lockbox
