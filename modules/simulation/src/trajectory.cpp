// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/trajectory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lockbox/core/lie.hpp"

namespace lockbox {
namespace {

constexpr double kPi = std::numbers::pi;

/// A time of rest at the run's beginning and end that differs from joint to joint, as a share of
/// the run: multiples of the golden ratio fill an interval evenly.
double pause(int variable, double shift) {
  const double x = variable * std::numbers::phi + shift;
  return 0.25 * (x - std::floor(x));
}

/// From rest to one end of the range, to the other, and back to rest.
class JointPath {
 public:
  JointPath(double rest, const VariableLimits& limits, int variable, double coverage)
      : begin_(pause(variable, 0.0)), end_(1.0 - pause(variable, 0.5)) {
    const bool bounded = std::isfinite(limits.lower) && std::isfinite(limits.upper);
    const double lower = bounded ? limits.lower : rest - kPi;
    const double upper = bounded ? limits.upper : rest + kPi;
    const double margin = 0.5 * (1.0 - coverage) * (upper - lower);
    double first = upper - margin;
    double second = lower + margin;
    if (std::abs(second - rest) > std::abs(first - rest)) {
      std::swap(first, second);
    }
    nodes_ = {rest, first, second, rest};
  }

  /// share: of the run, 0 to 1.
  double position(double share) const {
    const double x = std::clamp(3.0 * (share - begin_) / (end_ - begin_), 0.0, 3.0);
    const std::size_t leg = std::min<std::size_t>(2, static_cast<std::size_t>(x));
    const double progress = smooth_step(x - static_cast<double>(leg));
    return nodes_[leg] + progress * (nodes_[leg + 1] - nodes_[leg]);
  }

 private:
  double begin_;
  double end_;
  std::array<double, 4> nodes_;
};

/// T_start_camera: six slow oscillations of unequal frequency, at rest in the beginning.
Eigen::Isometry3d camera_motion(double time, const TrajectoryOptions& options) {
  const std::array<double, 6> hertz = {0.23, 0.17, 0.13, 0.19, 0.29, 0.11};
  Twist xi;
  for (int i = 0; i < 6; ++i) {
    const double amplitude = i < 3 ? options.sway : options.turn;
    xi[i] = amplitude * smooth_step(time) *
            std::sin(2.0 * kPi * hertz[static_cast<std::size_t>(i)] * time);
  }
  return exp_se3(xi);
}

}  // namespace

double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * t * (10.0 + t * (-15.0 + t * 6.0));
}

Eigen::Isometry3d facing_pose(double distance) {
  Eigen::Isometry3d T_camera_base = Eigen::Isometry3d::Identity();
  T_camera_base.linear().diagonal() << 1.0, -1.0, -1.0;
  T_camera_base.translation().z() = distance;
  return T_camera_base;
}

std::vector<State> generate_trajectory(const KinematicTree& tree,
                                       const TrajectoryOptions& options) {
  const Configuration rest = rest_configuration(tree);
  std::vector<JointPath> paths;
  paths.reserve(tree.variable_joint.size());
  for (int v = 0; v < tree.variables(); ++v) {
    paths.emplace_back(rest.q[v], variable_limits(tree, v), v, options.coverage);
  }
  std::vector<State> states;
  for (int frame = 0; frame < options.frames; ++frame) {
    State state;
    state.stamp = frame / options.rate;
    state.configuration.T_camera_base =
        camera_motion(state.stamp, options).inverse() * options.T_camera_base;
    state.configuration.q.resize(tree.variables());
    const double share = options.frames > 1 ? frame / (options.frames - 1.0) : 0.0;
    for (int v = 0; v < tree.variables(); ++v) {
      state.configuration.q[v] = paths[static_cast<std::size_t>(v)].position(share);
    }
    states.push_back(std::move(state));
  }
  return states;
}

}  // namespace lockbox
