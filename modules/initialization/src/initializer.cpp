// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/initialization/initializer.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "joint_scan.hpp"
#include "lockbox/core/error.hpp"
#include "search_workspace.hpp"

namespace lockbox {
namespace {

constexpr int kColumns = 160;        // of the view that hypotheses are judged in
constexpr int kFineColumns = 320;    // of the view that the best are compared in
constexpr double kFinePixels = 4.0;  // of it, in one of the coarser view
void check(const TiledCloud& cloud) {
  if (!cloud.has_image()) {
    throw InputError("cloud", "has no image, which the search for the object needs");
  }
}

}  // namespace

Initializer::Initializer(const ArticulatedModel& model, const InitializerOptions& options,
                         const Executor& executor)
    : workspace_(std::make_unique<Workspace>(model, options, executor)) {}
Initializer::~Initializer() = default;
Initializer::Initializer(Initializer&&) noexcept = default;
Initializer& Initializer::operator=(Initializer&&) noexcept = default;

std::vector<Candidate> Initializer::find(const TiledCloud& cloud,
                                         const std::optional<Configuration>& held) {
  SearchProgress progress;
  return find_part(cloud, held, std::numeric_limits<int>::max(), progress);
}

std::vector<Candidate> Initializer::glance(const TiledCloud& cloud) {
  SearchProgress progress;
  const int rounds = workspace_->is_flat ? 1 : std::numeric_limits<int>::max();
  return find_part(cloud, std::nullopt, rounds, progress);
}

std::vector<Candidate> Initializer::find_part(const TiledCloud& cloud,
                                              const std::optional<Configuration>& held,
                                              int most_rounds, SearchProgress& progress) {
  check(cloud);
  Workspace& w = *workspace_;
  w.held = held.value_or(rest_configuration(w.model.tree));
  const CoarseView view(cloud, kColumns, w.executor);
  CloudOptions unfiltered;
  unfiltered.flying_pixel_jump = 0.0;
  w.coarse_cloud.assign(view.camera, view.depth, unfiltered, w.executor);
  for (ViewScore& score : w.scores) score.set_view(view);

  const CoarseView fine_view(cloud, kFineColumns, w.executor);
  for (ViewScore& half : w.halves) half.set_view(fine_view);

  w.verifier.look_at(cloud, w.depth_noise(), w.executor);
  const PlanarScene scene = find_planes(view, w.view_noise());
  w.surroundings.set_scene(scene);
  std::vector<Candidate> candidates =
      w.seek_in_rounds(cloud, scene, fine_view, most_rounds, progress);
  if (!candidates.empty()) {
    w.rescan_joints(cloud, fine_view, candidates.front());
  }
  return candidates;
}

SoughtJoints Initializer::find_joints(const TiledCloud& cloud, const Configuration& start,
                                      const std::vector<int>& variables) {
  check(cloud);
  Workspace& w = *workspace_;
  std::vector<int> sought;
  std::copy_if(variables.begin(), variables.end(), std::back_inserter(sought),
               [&](int v) { return !w.options.registration.is_locked(v); });
  const CoarseView view(cloud, kColumns, w.executor);
  constexpr bool kIsKnown = true;
  w.scores.front().set_view(view, kIsKnown);
  SoughtJoints found{start, {}};
  scan_joints(w.model.tree, w.extent, w.scores.front(), sought, 0.01, kScan, found.configuration);
  found.margins = scan_joints(w.model.tree, w.extent, w.scores.front(), sought, 0.006, kScan,
                              found.configuration);
  for (double& margin : found.margins) margin *= kFinePixels;
  scan_by_image(w.low_prominence, cloud, sought, found.margins, w.options.stop_request,
                found.configuration);
  w.resolve_overlap(cloud, sought, found.margins, found.configuration);
  return found;
}

}  // namespace lockbox
