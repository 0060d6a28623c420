// SPDX-License-Identifier: BSD-3-Clause
#include "frame_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lockbox/core/error.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/units.hpp"

namespace lockbox {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double joint_error(const KinematicTree& tree, const State& estimate, const State& reference,
                   int joint) {
  const double error = joint_position(tree, estimate.configuration, joint) -
                       joint_position(tree, reference.configuration, joint);
  const bool turns_on = tree.joints[static_cast<std::size_t>(joint)].type == JointType::continuous;
  return turns_on ? std::remainder(error, kFullTurn) : error;
}

double sigma_of(const State& estimate, int column, const std::string& joint) {
  if (column < 0) return kUnknown;
  const std::string& field = estimate.extra[static_cast<std::size_t>(column)];
  const auto sigma = parse_number(field);
  if (!sigma) {
    throw InputError("column '" + joint + ".sigma' of the estimate",
                     "'" + field + "' is not a number");
  }
  return *sigma;
}

}  // namespace

FrameComparison::FrameComparison(const KinematicTree& tree,
                                 const std::vector<std::string>& extra_columns, EqualPoses equal)
    : tree_(tree), equal_(std::move(equal)) {
  for (const Joint& joint : tree.joints) {
    const auto found = std::find(extra_columns.begin(), extra_columns.end(), joint.name + ".sigma");
    sigma_columns_.push_back(
        found == extra_columns.end() ? -1 : static_cast<int>(found - extra_columns.begin()));
  }
}

FrameErrors FrameComparison::nothing(double stamp) const {
  const auto joints = static_cast<Eigen::Index>(tree_.joints.size());
  return {stamp,
          "",
          kUnknown,
          kUnknown,
          Eigen::VectorXd::Constant(joints, kUnknown),
          Eigen::VectorXd::Constant(joints, kUnknown),
          {}};
}

FrameErrors FrameComparison::compare(const State& estimate, const State& reference) const {
  FrameErrors frame = nothing(reference.stamp);
  frame.status = estimate.status;
  if (!estimate.known || !reference.known) return frame;
  const Eigen::Isometry3d& T_estimate = estimate.configuration.T_camera_base;
  const Eigen::Isometry3d T_reference =
      equal_.nearest(reference.configuration.T_camera_base, T_estimate);
  frame.translation = (T_estimate.translation() - T_reference.translation()).norm();
  frame.rotation = log_so3(T_reference.linear().transpose() * T_estimate.linear()).norm();
  for (std::size_t j = 0; j < tree_.joints.size(); ++j) {
    const auto index = static_cast<Eigen::Index>(j);
    frame.joints[index] = joint_error(tree_, estimate, reference, static_cast<int>(j));
    frame.joint_sigmas[index] = sigma_of(estimate, sigma_columns_[j], tree_.joints[j].name);
  }
  return frame;
}

}  // namespace lockbox
