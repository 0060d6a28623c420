// SPDX-License-Identifier: BSD-3-Clause
// What the stages of the search do with one hypothesis: register, draw, compare.
#include "climb.hpp"
#include "search_workspace.hpp"

namespace lockbox {
namespace {

constexpr double kHardlyWorse = 0.01;  // of the visible surface
/// Coarse steps for a view of coarse pixels.
const ClimbPlan kClimbFar{{0.03, 0.015, 0.008, 0.004}, 3, 0.006};
const Annealing kExactly{.spread = 0.005, .iterations = 8};

}  // namespace

void Initializer::Workspace::resolve_overlap(const TiledCloud& cloud, const std::vector<int>& which,
                                             Configuration& configuration) {
  for (const int v : which) {
    if (!overlap.overlaps(configuration)) return;
    const Configuration moved = overlap.with_moved(configuration, v);
    const double before = align_finely(cloud, configuration, {0.0, 0}).agreement.conviction();
    const double after = align_finely(cloud, moved, {0.0, 0}).agreement.conviction();
    if (after > before - kHardlyWorse) configuration = moved;
  }
}

/// Unless less is explained then. A drawing in pixels cannot tell: its score may be a quarter
/// lower.
void Initializer::Workspace::align_exactly(const TiledCloud& cloud, Configuration& configuration) {
  const TiledCloud& object =
      surroundings.left_out_of(cloud, configuration, depth_noise(), parts.front());
  const double before = align_finely(object, configuration, {0.0, 0}).agreement.conviction();
  const RegistrationResult& exact = align_finely(object, configuration, kExactly);
  if (exact.agreement.conviction() > before - kHardlyWorse) configuration = exact.configuration;
}

const RegistrationResult& Initializer::Workspace::align_finely(const TiledCloud& cloud,
                                                               const Configuration& start,
                                                               const Annealing& annealing) {
  stop_if(options.stop_request);
  return fine.align(cloud, start, annealing);
}

void Initializer::Workspace::align_coarsely(double spread, int iterations,
                                            Configuration& configuration, bool hold_joints) {
  stop_if(options.stop_request);
  const std::size_t worker = Executor::worker();
  const TiledCloud& object =
      surroundings.left_out_of(coarse_cloud, configuration, view_noise(), parts[worker]);
  configuration =
      coarse[worker].align(object, configuration, {spread, iterations, hold_joints}).configuration;
}

/// To where the drawing in the coarse view fits best.
void Initializer::Workspace::climb_far(Configuration& configuration) {
  climb(model.tree, levers, variables, std::span(&score(), 1), Executor(1), kClimbFar,
        configuration);
}

double Initializer::Workspace::judge(const Hypothesis& hypothesis, double slack, double tolerance,
                                     bool is_close) {
  ViewScore& view = is_close ? halves[Executor::worker()] : score();
  return view.evidence(hypothesis.configuration, slack, hypothesis.bodies).total(tolerance);
}

/// In a finer view, which shows more of what the camera saw through.
double Initializer::Workspace::judge_closely(const Configuration& configuration, double slack) {
  return halves[Executor::worker()].evidence(configuration, slack, all_bodies).total(0.0);
}

}  // namespace lockbox
