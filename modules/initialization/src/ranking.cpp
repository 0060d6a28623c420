// SPDX-License-Identifier: BSD-3-Clause
// The last stages of the search without a guess (docs/initialization.md): which answer is the most
// convincing.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "search_workspace.hpp"

namespace lockbox {
namespace {

constexpr Selection kRanked{0.0, 32, kSamePlace, 2};
constexpr double kEnoughPixels = 80.0;
/// Of 2024 right answers in random scenes 99.9 % are contradicted by less than 0.83 % of the pixels
/// that speak, of 29 wrong ones only nine.
constexpr double kContradicted = 24.0;

/// Of the bodies for or against which enough speaks: one that stands elsewhere vanishes in the
/// whole.
double least_consent(const std::vector<Agreement>& bodies) {
  double least = 1.0;
  for (const Agreement& body : bodies) {
    const double heard = (body.explained + body.contradicted) * body.pixels;
    if (heard >= kEnoughPixels) least = std::min(least, body.consent());
  }
  return least;
}

}  // namespace

std::vector<Candidate> Initializer::Workspace::rank(const TiledCloud& cloud,
                                                    const std::vector<Hypothesis>& hypotheses) {
  std::vector<Answer> answers;
  for (const Hypothesis& hypothesis : best_apart(hypotheses, kRanked, levers)) {
    if (hypothesis.score <= 0.0) continue;
    Configuration configuration = hypothesis.configuration;
    resolve_overlap(cloud, variables, configuration);
    align_exactly(cloud, configuration);
    const auto& result = align_finely(cloud, configuration, {0.0, 0});
    const double consent = least_consent(result.body_agreement);
    const double trust = consent * std::pow(result.agreement.consent(), kContradicted);
    const ViewEvidence evidence = halves.front().last_evidence(configuration, kFineSlack);
    const double distance = configuration.T_camera_base.translation().norm();
    Candidate candidate;
    candidate.configuration = configuration;
    candidate.score = trust * evidence.conviction(distance);
    candidate.agreement = result.agreement;
    answers.push_back(
        {candidate, consent * evidence.total(0.0), halves.front().explained_pixels(kFineSlack)});
  }
  sort_best_first(answers, levers);
  if (answers.size() > options.most_candidates) answers.resize(options.most_candidates);
  std::vector<Candidate> candidates;
  std::transform(answers.begin(), answers.end(), std::back_inserter(candidates),
                 [](const Answer& answer) { return answer.candidate; });
  if (!candidates.empty()) candidates.front().rival_distance = rival_distance(answers, levers);
  return candidates;
}

}  // namespace lockbox
