// SPDX-License-Identifier: BSD-3-Clause
#include "climb.hpp"

#include <algorithm>
#include <array>

#include "levers.hpp"
#include "lockbox/core/lie.hpp"

namespace lockbox {
namespace {

constexpr std::array<double, 3> kSteps{0.004, 0.002, 0.001};  // metres that surfaces move
constexpr int kRounds = 2;                                    // with each of them
constexpr double kSlack = 0.002;  // metres: what real objects differ from their models by

/// The configuration with one unknown (base twist about the centre, joint variables) changed so
/// that no surface moves farther than `step`.
Configuration moved(const KinematicTree& tree, const Configuration& configuration,
                    const ModelLevers& levers, int unknown, double step) {
  Configuration result = configuration;
  if (unknown >= 6) {
    const VariableLimits limits = variable_limits(tree, unknown - 6);
    double& q = result.q[unknown - 6];
    const double lever = levers.variables[unknown - 6];
    if (lever > 0.0) q = std::clamp(q + step / lever, limits.lower, limits.upper);
    return result;
  }
  Twist twist = Twist::Zero();
  twist[unknown] = unknown < 3 ? step : step / levers.radius;
  const Eigen::Isometry3d T_base_centre(Eigen::Translation3d(levers.centre));
  result.T_camera_base = orthonormalized(configuration.T_camera_base * T_base_centre *
                                         exp_se3(twist) * T_base_centre.inverse());
  return result;
}

}  // namespace

void climb(const KinematicTree& tree, ViewScore& score, Configuration& configuration) {
  const int unknowns = 6 + tree.variables();
  const ModelLevers levers = model_levers(tree);
  double best = score.fit(configuration, kSlack);
  for (const double step : kSteps) {
    for (int round = 0; round < kRounds; ++round) {
      for (int unknown = 0; unknown < unknowns; ++unknown) {
        for (const double direction : {1.0, -1.0}) {
          Configuration trial = moved(tree, configuration, levers, unknown, direction * step);
          const double fit = score.fit(trial, kSlack);
          if (fit > best) {
            best = fit;
            configuration = std::move(trial);
            break;
          }
        }
      }
    }
  }
}

}  // namespace lockbox
