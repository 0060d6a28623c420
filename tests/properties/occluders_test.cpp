// SPDX-License-Identifier: BSD-3-Clause
// Property "occluders are harmless": an object 5 cm or more in front of the model moves no estimate
// by more than the noise does; one that touches it, by no more than 3 sigma, with sigma grown.
#include <gtest/gtest.h>

#include <cmath>

#include "initialization/seen_model.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/simulation/trajectory.hpp"

namespace lockbox {
namespace {

class Occluders : public ::testing::Test {
 protected:
  const ArticulatedModel& model_ = shipped("lockbox");
  const Eigen::Index unknowns_ = model_.tree.unknowns();
  const Configuration truth_ = [this] {
    Configuration configuration = *model_.parameters.initial_configuration;
    set_joint_position(model_.tree, configuration, "block", 0.1);
    set_joint_position(model_.tree, configuration, "slider", 0.1);
    set_joint_position(model_.tree, configuration, "latch", 0.3);
    return configuration;
  }();

  /// From where tracking would start, unless told.
  RegistrationResult registered(const Scene& scene,
                                const AlignOptions& align_options = {0.003, 15, false, 3}) const {
    ArticulatedRegistration registration(model_, {}, Executor());
    return registration.align(seen(model_, truth_, scene), truth_, align_options);
  }

  Eigen::VectorXd difference(const Configuration& a, const Configuration& b) const {
    Eigen::VectorXd step(unknowns_);
    step << log_se3(b.T_camera_base.inverse() * a.T_camera_base), a.q - b.q;
    return step;
  }

  /// A box whose back lies at that height over the base's origin, base frame.
  static SceneBox box_at(double x, double y, double back) {
    SceneBox box;
    box.frame = SceneFrame::base;
    box.size = {0.15, 0.15, 0.1};
    box.pose.translation() = Eigen::Vector3d(x, y, back + 0.05);
    return box;
  }

  double highest() const {
    BodyPoses poses;
    Configuration in_base = truth_;
    in_base.T_camera_base.setIdentity();
    forward_kinematics(model_.tree, in_base, poses);
    double top = 0.0;
    for (std::size_t b = 0; b < poses.size(); ++b) {
      top = std::max(top, model_.fields[b]->bounds().transformed(poses[b]).max().z());
    }
    return top;
  }
};

TEST_F(Occluders, InFrontMoveNoEstimateByMoreThanTheNoise) {
  const Scene free_scene = wall_behind(0.6);
  const RegistrationResult alone = registered(free_scene);
  for (const double gap : {0.05, 0.15}) {
    for (const double x : {-0.25, 0.25}) {
      for (const double y : {-0.25, 0.25}) {
        Scene scene = free_scene;
        scene.boxes.push_back(box_at(x, y, highest() + gap));
        const RegistrationResult hidden = registered(scene);
        const Eigen::VectorXd moved = difference(hidden.configuration, alone.configuration);
        double squares = 0.0;
        double count = 0.0;
        for (Eigen::Index i = 0; i < unknowns_; ++i) {
          if (!hidden.observable[static_cast<std::size_t>(i)]) {
            continue;
          }
          const double normalised = moved[i] / hidden.sigma_of_noise[i];
          EXPECT_LT(std::abs(normalised), 3.0)
              << "unknown " << i << ", box at " << x << " " << y << ", " << gap << " before";
          squares += normalised * normalised;
          count += 1.0;
        }
        EXPECT_LT(squares, count) << "box at " << x << " " << y << ", " << gap << " before";
      }
    }
  }
}

TEST_F(Occluders, ThatHideMostDoNotPullWhileGatesAreWide) {
  constexpr double kAnnealingSigma = 0.015;
  for (const double side : {-1.0, 1.0}) {
    for (const double tilt : {-0.1, 0.0, 0.1}) {
      Scene scene = wall_behind(0.6);
      SceneBox plank = box_at(0.0, 0.0, 0.0);
      plank.size = {1.6, 0.6, 0.04};
      const double lowest_edge = 0.3 * std::abs(std::sin(tilt)) + 0.02;  // under its middle
      plank.pose = Eigen::Translation3d(0.0, 0.1 * side, highest() + 0.03 + lowest_edge) *
                   Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX());
      scene.boxes.push_back(plank);
      const RegistrationResult hidden = registered(scene, {kAnnealingSigma, 8});
      const Twist moved =
          log_se3(truth_.T_camera_base.inverse() * hidden.configuration.T_camera_base);
      EXPECT_LT(moved.head<3>().norm(), 0.001) << "side " << side << ", tilted by " << tilt;
      EXPECT_LT(moved.tail<3>().norm(), 0.002) << "side " << side << ", tilted by " << tilt;
    }
  }
}

TEST_F(Occluders, ThatTouchMoveNoEstimateByMoreThanThreeSigma) {
  const Scene free_scene = wall_behind(0.6);
  const RegistrationResult alone = registered(free_scene);
  const auto log_volume = [](const RegistrationResult& result) {
    return result.sigma_of_noise.head<6>().array().log().sum();
  };
  for (const double x : {-0.1, 0.15, 0.3}) {
    for (const double y : {0.1, 0.3}) {
      Scene scene = free_scene;
      scene.boxes.push_back(box_at(x, y, 0.0));  // upon the board
      const RegistrationResult touched = registered(scene);
      const Eigen::VectorXd moved = difference(touched.configuration, alone.configuration);
      for (Eigen::Index i = 0; i < unknowns_; ++i) {
        if (touched.observable[static_cast<std::size_t>(i)]) {
          EXPECT_LT(std::abs(moved[i]), 3.0 * touched.sigma_of_noise[i])
              << "unknown " << i << ", box at " << x << " " << y;
        }
      }
      // What is hidden says nothing.
      EXPECT_GT(log_volume(touched), log_volume(alone)) << "box at " << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace lockbox
