// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/motion_predictor.hpp"

#include <algorithm>

namespace lockbox {
namespace {

constexpr double kLeastSigma = 0.003;    // metres
constexpr double kLargestSigma = 0.005;  // metres: wider gates drag parts onto each other
constexpr double kSigmaFactor = 1.0;     // of the latest surface error
constexpr double kSigmaDecay = 0.7;      // a frame
constexpr double kLongestStep = 0.2;     // seconds: beyond it no velocity says anything

}  // namespace

MotionPredictor::MotionPredictor(const KinematicTree& tree)
    : tree_(tree), joint_velocity_(Eigen::VectorXd::Zero(tree.variables())) {}

void MotionPredictor::reset(double stamp, const Configuration& configuration) {
  stamp_ = stamp;
  last_ = configuration;
  last_observable_.assign(static_cast<std::size_t>(tree_.unknowns()), true);
  base_velocity_.setZero();
  joint_velocity_.setZero();
  annealing_sigma_ = kLargestSigma;
}

Configuration MotionPredictor::predict(double stamp) const {
  const double dt = stamp - stamp_;
  if (!(dt > 0.0) || dt > kLongestStep) {
    return last_;
  }
  Configuration prediction = last_;
  prediction.T_camera_base = last_.T_camera_base * exp_se3(dt * base_velocity_);
  for (int v = 0; v < tree_.variables(); ++v) {
    const VariableLimits limits = variable_limits(tree_, v);
    prediction.q[v] = std::clamp(last_.q[v] + dt * joint_velocity_[v], limits.lower, limits.upper);
  }
  return prediction;
}

void MotionPredictor::update(double stamp, const Configuration& configuration,
                             const std::vector<bool>& observable, double surface_error) {
  const double dt = stamp - stamp_;
  if (dt > 0.0 && dt <= kLongestStep) {
    base_velocity_ = log_se3(last_.T_camera_base.inverse() * configuration.T_camera_base) / dt;
    for (int i = 0; i < kBaseUnknowns; ++i) {
      const auto unknown = static_cast<std::size_t>(i);
      if (!observable[unknown] || !last_observable_[unknown]) base_velocity_[i] = 0.0;
    }
    for (int v = 0; v < tree_.variables(); ++v) {
      const auto unknown = static_cast<std::size_t>(unknown_of(v));
      const bool seen_twice = observable[unknown] && last_observable_[unknown];
      joint_velocity_[v] = seen_twice ? (configuration.q[v] - last_.q[v]) / dt : 0.0;
    }
  } else {
    base_velocity_.setZero();
    joint_velocity_.setZero();
  }
  annealing_sigma_ =
      std::clamp(std::max(kSigmaDecay * annealing_sigma_, kSigmaFactor * surface_error),
                 kLeastSigma, kLargestSigma);
  stamp_ = stamp;
  last_ = configuration;
  last_observable_ = observable;
}

}  // namespace lockbox
