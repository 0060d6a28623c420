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

constexpr int kColumns = 160;              // of the view that hypotheses are judged in
constexpr int kFineColumns = 320;          // of the view that the best are compared in
constexpr double kFinePixels = 4.0;        // of it, in one of the coarser view
constexpr std::size_t kLeastSamples = 20;  // of a planar region
constexpr std::size_t kMostRegions = 32;
/// What is believed less is sought with the smaller planes of the finer view, too, and what still
/// is with more of everything.
constexpr double kConvincing = 0.99999;
constexpr double kPossible = 0.99;
constexpr Breadth kUsual{8, {0.1, 96, 0.5, 16}, {0.1, 40, 0.5, 8}, {0.15, 8, 0.5, 2}, false, false};
constexpr Breadth kWide{32,   {0.03, 400, 0.5, 64}, {0.03, 120, 0.5, 16}, {0.02, 24, 0.5, 4}, true,
                        false};
/// Of points, which propose many places that look alike from afar, of things that are mostly small.
constexpr Breadth kOfPoints{
    8, {0.03, 128, 0.5, 16}, {0.03, 64, 0.5, 12}, {0.05, 16, 0.5, 4}, false, true};

PlanarScene planes(const CoarseView& view, double noise) {
  return {view, noise, find_planar_regions(view, noise, kLeastSamples, kMostRegions)};
}

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
  constexpr bool kIsThorough = true;
  return look(cloud, held, kIsThorough);
}

std::vector<Candidate> Initializer::glance(const TiledCloud& cloud) {
  constexpr bool kIsThorough = false;
  return look(cloud, std::nullopt, kIsThorough);
}

std::vector<Candidate> Initializer::look(const TiledCloud& cloud,
                                         const std::optional<Configuration>& held,
                                         bool is_thorough) {
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
  const PlanarScene scene = planes(view, w.view_noise());
  w.surroundings.set_scene(scene);
  std::vector<Candidate> candidates = w.seek_until_convinced(cloud, scene, fine_view, is_thorough);
  if (!candidates.empty()) {
    w.settle(cloud, fine_view, candidates.front());
  }
  return candidates;
}

std::vector<Candidate> Initializer::Workspace::seek_until_convinced(const TiledCloud& cloud,
                                                                    const PlanarScene& scene,
                                                                    const CoarseView& fine_view,
                                                                    bool is_thorough) {
  std::vector<Candidate> answers;
  double most_evidence = -std::numeric_limits<double>::infinity();
  const auto belief_in = [&](std::vector<Hypothesis> matched, const Breadth& breadth) {
    assess(cloud, followed(cloud, std::move(matched), breadth), answers);
    if (answers.empty()) return 0.0;
    // Back to front or upside down, it may look nearly the same, and be passed over.
    if (answers.front().evidence > most_evidence) {
      assess(cloud, seek_turned(cloud, answers.front().configuration), answers);
      most_evidence = answers.front().evidence;
    }
    return answers.front().belief;
  };
  const auto seek_until = [&] {
    if (belief_in(match(scene, kUsual), kUsual) >= kConvincing) return;
    if (!is_flat) {
      belief_in(match_points(fine_view, scene, kOfPoints), kOfPoints);
      return;
    }
    if (!is_thorough) return;
    const PlanarScene closer = planes(fine_view, fine_view_noise());
    if (belief_in(match(closer, kUsual), kUsual) >= kPossible) return;
    if (belief_in(match_points(fine_view, scene, kOfPoints), kOfPoints) >= kPossible) return;
    if (belief_in(match(scene, kWide), kWide) < kPossible) belief_in(match(closer, kWide), kWide);
  };
  seek_until();
  answers.resize(std::min(answers.size(), options.most_candidates));
  return answers;
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
  scan_joints(w.model.tree, w.levers, w.scores.front(), sought, 0.01, kScan, found.configuration);
  found.margins = scan_joints(w.model.tree, w.levers, w.scores.front(), sought, 0.006, kScan,
                              found.configuration);
  for (double& margin : found.margins) margin *= kFinePixels;
  scan_by_image(w.low_relief, cloud, sought, found.margins, w.options.stop_request,
                found.configuration);
  w.resolve_overlap(cloud, sought, found.configuration);
  return found;
}

}  // namespace lockbox
