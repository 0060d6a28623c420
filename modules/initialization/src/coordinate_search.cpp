// SPDX-License-Identifier: BSD-3-Clause
#include "coordinate_search.hpp"

#include <algorithm>
#include <array>

#include "lockbox/core/lie.hpp"
#include "model_extent.hpp"

namespace lockbox {
namespace {

/// The configuration with one unknown (base twist about the centre, joint variables) changed so
/// that no surface moves farther than `step`.
Configuration moved(const KinematicTree& tree, const Configuration& configuration,
                    const ModelExtent& extent, int unknown, double step) {
  Configuration result = configuration;
  if (unknown >= kBaseUnknowns) {
    const int variable = unknown - kBaseUnknowns;
    const VariableLimits limits = variable_limits(tree, variable);
    double& q = result.q[variable];
    const double motion_scale = extent.variables[variable];
    if (motion_scale > 0.0) q = std::clamp(q + step / motion_scale, limits.lower, limits.upper);
    return result;
  }
  Twist twist = Twist::Zero();
  twist[unknown] = unknown < 3 ? step : step / extent.radius;
  const Eigen::Isometry3d T_base_centre(Eigen::Translation3d(extent.centre));
  result.T_camera_base = orthonormalized(configuration.T_camera_base * T_base_centre *
                                         exp_se3(twist) * T_base_centre.inverse());
  return result;
}

}  // namespace

void coordinate_search(const KinematicTree& tree, const ModelExtent& extent,
                       const std::vector<int>& variables, std::span<ViewScore> scores,
                       const Executor& executor, const CoordinateSearchPlan& plan,
                       Configuration& configuration) {
  std::vector<int> unknowns{0, 1, 2, 3, 4, 5};
  for (const int variable : variables) unknowns.push_back(unknown_of(variable));
  double best = scores.front().fit(configuration, plan.slack);
  std::array<Configuration, 2> trials;  // to either side
  std::array<double, 2> fits{};
  for (const double step : plan.steps) {
    bool is_better = true;
    for (int round = 0; round < plan.rounds && is_better; ++round) {
      is_better = false;
      for (const int unknown : unknowns) {
        executor.for_each(trials.size(), [&](std::size_t side) {
          const double way = side == 0 ? step : -step;
          trials[side] = moved(tree, configuration, extent, unknown, way);
          fits[side] = scores[Executor::worker()].fit(trials[side], plan.slack);
        });
        const std::size_t side = fits[0] > best ? 0 : 1;
        if (fits[side] > best) {
          best = fits[side];
          is_better = true;
          configuration = trials[side];
        }
      }
    }
  }
}

}  // namespace lockbox
