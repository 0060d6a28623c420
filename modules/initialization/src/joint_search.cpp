// SPDX-License-Identifier: BSD-3-Clause
#include "joint_search.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "image_scan.hpp"
#include "joint_scan.hpp"
#include "lockbox/verification/belief.hpp"

namespace lockbox {
namespace {

constexpr bool kIsKnown = true;
constexpr double kFinePixels = 4.0;  // of the finer view, in one of the coarser
/// Metres that surfaces may be off: of an answer that was refined; around a base that is known, at
/// first and at last. Source: not recorded. Doubled, positions of a joint are told apart less.
constexpr double kRefinedSlack = 0.003;
constexpr double kFirstSlack = 0.01;
constexpr double kLastSlack = 0.006;
/// Of what a joint moves, the share that is explained, as TrackerOptions::least_of_sought_body.
constexpr double kMostlyHidden = 0.5;
/// Log odds of a position against any other, with which it is known: 99 to 1, as belief of the
/// base. Doubled, few parts of which a strip is in view are.
constexpr double kSurelyThere = 4.6;

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

void JointSearch::rescan(SearchImage& image, Assessment& assessment, Candidate& answer) {
  fine_.set_view(image.fine_view(), kIsKnown);
  const std::vector<int>& variables = sought_.variables;
  Configuration& configuration = answer.configuration;
  ScannedJoints scanned = scan_joints(sought_.model.tree, sought_.extent, fine_, variables,
                                      kRefinedSlack, kScan, configuration);
  answer.margins = std::move(scanned.margins);
  scan_by_image(low_prominence_, image.cloud(), variables, answer.margins, options_.stop_request,
                configuration);
  exact_.resolve_overlap(image.cloud(), variables, answer.margins, configuration);
  exact_.refine(image, configuration);
  doubt_hidden(image, assessment, scanned.peaks, answer);
}

/// What hides a part for the most part may pass for it, at some other position. A drawing goes by
/// pixels, evidence by lines: where the two do not agree, nobody knows.
void JointSearch::doubt_hidden(SearchImage& image, Assessment& assessment,
                               const std::vector<std::vector<double>>& peaks, Candidate& answer) {
  const KinematicTree& tree = sought_.model.tree;
  const RegistrationResult seen = exact_.compare(image.cloud(), answer.configuration);
  const double evidence = assessment.evidence(answer.configuration);
  for (const int variable : sought_.variables) {
    const auto v = static_cast<std::size_t>(variable);
    const auto joint = static_cast<std::size_t>(tree.variable_joint[v]);
    const auto body = static_cast<std::size_t>(tree.joints[joint].child_body);
    if (!(seen.body_agreement[body].explained < kMostlyHidden)) continue;
    for (const double position : peaks[v]) {
      Configuration other = answer.configuration;
      other.q[variable] = position;
      exact_.refine(image, other);
      const double turned = std::abs(other.q[variable] - answer.configuration.q[variable]);
      if (turned * sought_.extent.variables[variable] < least_apart(sought_.extent)) continue;
      const double against = assessment.evidence(other);
      if (log_odds(evidence, against, sought_.evidence) < kSurelyThere)
        answer.margins[v] = kNotTold;
    }
  }
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
                              kScan, found.configuration)
                      .margins;
  for (double& margin : found.margins) margin *= kFinePixels;
  scan_by_image(low_prominence_, cloud, sought, found.margins, options_.stop_request,
                found.configuration);
  exact_.resolve_overlap(cloud, sought, found.margins, found.configuration);
  return found;
}

}  // namespace lockbox
