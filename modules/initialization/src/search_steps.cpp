// SPDX-License-Identifier: BSD-3-Clause
// What the stages of the search do with one hypothesis: register, draw, compare.
#include <algorithm>
#include <cmath>
#include <optional>

#include "coordinate_search.hpp"
#include "lockbox/model/moved_bodies.hpp"
#include "search_workspace.hpp"

namespace lockbox {
namespace {

constexpr double kHardlyWorse = 0.01;  // of the visible surface
/// Coarse steps for a view of coarse pixels.
const CoordinateSearchPlan kSearchFar{{0.03, 0.015, 0.008, 0.004}, 3, 0.006};
/// Slowly, until nothing moves: of an answer that came to rest before its time too little is
/// believed, and so of its turn, or too much. With 8 iterations a board on a wall had 239 nats, and
/// turned by 180 degrees, which looks the same, 267; with 30 both have 295.
const AlignOptions kExactly{.annealing_sigma = 0.005, .iterations = 30};

/// Whether all that the variable moves was sought, and none of it can be seen anywhere.
bool is_out_of_sight(const KinematicTree& tree, int variable, const std::vector<int>& sought,
                     const JointMargins& margins) {
  if (margins.empty()) return false;
  const std::vector<std::uint8_t> moved = moved_bodies(tree, variable);
  return std::all_of(tree.joints.begin(), tree.joints.end(), [&](const Joint& joint) {
    const int v = joint.variable;
    return v < 0 || moved[static_cast<std::size_t>(joint.child_body)] == 0 ||
           (std::isinf(margins[static_cast<std::size_t>(v)]) &&
            std::find(sought.begin(), sought.end(), v) != sought.end());
  });
}

}  // namespace

void Initializer::Workspace::resolve_overlap(const TiledCloud& cloud, const std::vector<int>& which,
                                             const JointMargins& margins,
                                             Configuration& configuration) {
  const auto explained = [&](const Configuration& with) {
    return align_finely(cloud, with, {0.0, 0}).agreement.score();
  };
  std::optional<double> before;
  for (const int v : which) {
    if (!overlap.overlaps(configuration, v)) continue;
    const Configuration moved = overlap.with_moved(configuration, v);
    if (is_out_of_sight(model.tree, v, which, margins)) {
      configuration = moved;
      continue;
    }
    if (!before) before = explained(configuration);
    const double after = explained(moved);
    if (!(after > *before - kHardlyWorse)) continue;
    configuration = moved;
    before = after;
  }
}

/// Unless less is explained then. A drawing in pixels cannot tell: its score may be a quarter
/// lower.
void Initializer::Workspace::align_exactly(const TiledCloud& cloud, Configuration& configuration) {
  const TiledCloud& object =
      surroundings.left_out_of(cloud, configuration, depth_noise(), parts.front());
  const double before = align_finely(object, configuration, {0.0, 0}).agreement.score();
  const RegistrationResult exact = align_finely(object, configuration, kExactly);
  if (exact.agreement.score() > before - kHardlyWorse) configuration = exact.configuration;
}

RegistrationResult Initializer::Workspace::align_finely(const TiledCloud& cloud,
                                                        const Configuration& start,
                                                        const AlignOptions& align_options) {
  stop_if(options.stop_request);
  return fine.align(cloud, start, align_options);
}

void Initializer::Workspace::align_coarsely(double annealing_sigma, int iterations,
                                            Configuration& configuration, bool hold_joints) {
  stop_if(options.stop_request);
  const std::size_t worker = Executor::worker();
  const TiledCloud& object =
      surroundings.left_out_of(coarse_cloud, configuration, view_noise(), parts[worker]);
  configuration = coarse[worker]
                      .align(object, configuration, {annealing_sigma, iterations, hold_joints})
                      .configuration;
}

/// To where the drawing in the coarse view fits best.
void Initializer::Workspace::search_coordinates_far(Configuration& configuration) {
  coordinate_search(model.tree, extent, variables, std::span(&score(), 1), Executor(1), kSearchFar,
                    configuration);
}

double Initializer::Workspace::score_of(const Hypothesis& hypothesis, double slack,
                                        double tolerance, bool is_close) {
  ViewScore& view = is_close ? halves[Executor::worker()] : score();
  return view.evidence(hypothesis.configuration, slack, hypothesis.bodies).total(tolerance);
}

/// In a finer view, which shows more of what the camera saw through.
double Initializer::Workspace::score_closely(const Configuration& configuration, double slack) {
  return halves[Executor::worker()].evidence(configuration, slack, all_bodies).total(0.0);
}

}  // namespace lockbox
