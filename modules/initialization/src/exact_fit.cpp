// SPDX-License-Identifier: BSD-3-Clause
#include "exact_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lockbox/model/moved_bodies.hpp"

namespace lockbox {
namespace {

constexpr double kHardlyWorse = 0.01;  // of the visible surface
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

ExactFit::ExactFit(const ArticulatedModel& model, const InitializerOptions& options,
                   const Executor& executor)
    : tree_(model.tree),
      stop_request_(options.stop_request),
      registration_(model, options.registration, executor),
      overlap_(model, registration_.collision()) {}

RegistrationResult ExactFit::align(const TiledCloud& cloud, const Configuration& start,
                                   const AlignOptions& align_options) {
  stop_if(stop_request_);
  return registration_.align(cloud, start, align_options);
}

RegistrationResult ExactFit::compare(const TiledCloud& cloud, const Configuration& there) {
  return align(cloud, there, {.annealing_sigma = 0.0, .iterations = 0});
}

/// A drawing in pixels cannot tell: its score may be a quarter lower.
void ExactFit::refine(SearchImage& image, Configuration& configuration) {
  const TiledCloud& object = image.object(configuration);
  const double before = compare(object, configuration).agreement.score();
  const RegistrationResult exact = align(object, configuration, kExactly);
  if (exact.agreement.score() > before - kHardlyWorse) configuration = exact.configuration;
}

void ExactFit::resolve_overlap(const TiledCloud& cloud, const std::vector<int>& variables,
                               const JointMargins& margins, Configuration& configuration) {
  std::optional<double> before;
  for (const int v : variables) {
    if (!overlap_.overlaps(configuration, v)) continue;
    const Configuration moved = overlap_.with_moved(configuration, v);
    if (is_out_of_sight(tree_, v, variables, margins)) {
      configuration = moved;
      continue;
    }
    if (!before) before = compare(cloud, configuration).agreement.score();
    const double after = compare(cloud, moved).agreement.score();
    if (!(after > *before - kHardlyWorse)) continue;
    configuration = moved;
    before = after;
  }
}

}  // namespace lockbox
