// SPDX-License-Identifier: BSD-3-Clause
#include "joint_search.hpp"

#include <algorithm>
#include <iterator>

#include "joint_scan.hpp"

namespace lockbox {
namespace {

constexpr bool kIsKnown = true;
constexpr double kFinePixels = 4.0;  // of the finer view, in one of the coarser
/// Metres that surfaces may be off: of an answer that was refined; around a base that is known, at
/// first and at last. Source: not recorded. Doubled, positions of a joint are told apart less.
constexpr double kRefinedSlack = 0.003;
constexpr double kFirstSlack = 0.01;
constexpr double kLastSlack = 0.006;

}  // namespace

JointSearch::JointSearch(const SoughtModel& sought, const InitializerOptions& options,
                         const ViewNoise& noise, ExactFit& exact, const Executor& executor)
    : sought_(sought),
      options_(options),
      executor_(executor),
      exact_(exact),
      coarse_(sought.from_afar, noise.coarse, options.stop_request),
      fine_(sought.from_afar, noise.fine, options.stop_request),
      low_prominence_(sought.model, options.registration, executor) {}

void JointSearch::rescan(SearchImage& image, Candidate& answer) {
  fine_.set_view(image.fine_view(), kIsKnown);
  const std::vector<int>& variables = sought_.variables;
  Configuration& configuration = answer.configuration;
  answer.margins = scan_joints(sought_.model.tree, sought_.extent, fine_, variables, kRefinedSlack,
                               kScan, configuration);
  scan_by_image(low_prominence_, image.cloud(), variables, answer.margins, options_.stop_request,
                configuration);
  exact_.resolve_overlap(image.cloud(), variables, answer.margins, configuration);
  exact_.refine(image, configuration);
}

SoughtJoints JointSearch::find(const TiledCloud& cloud, const Configuration& start,
                               const std::vector<int>& variables) {
  std::vector<int> sought;
  std::copy_if(variables.begin(), variables.end(), std::back_inserter(sought),
               [&](int v) { return !options_.registration.is_locked(v); });
  const CoarseView view(cloud, kCoarseColumns, executor_);
  coarse_.set_view(view, kIsKnown);
  SoughtJoints found{start, {}};
  scan_joints(sought_.model.tree, sought_.extent, coarse_, sought, kFirstSlack, kScan,
              found.configuration);
  found.margins = scan_joints(sought_.model.tree, sought_.extent, coarse_, sought, kLastSlack,
                              kScan, found.configuration);
  for (double& margin : found.margins) margin *= kFinePixels;
  scan_by_image(low_prominence_, cloud, sought, found.margins, options_.stop_request,
                found.configuration);
  exact_.resolve_overlap(cloud, sought, found.margins, found.configuration);
  return found;
}

}  // namespace lockbox
