// SPDX-License-Identifier: BSD-3-Clause
// The last stages of the search without a guess (docs/initialization.md): which answer is the most
// convincing.
#include <algorithm>
#include <limits>
#include <utility>

#include "rivals.hpp"
#include "search_workspace.hpp"

namespace lockbox {
namespace {

void set_evidence(const Evidence& evidence, Candidate& candidate) {
  candidate.evidence = evidence.total();
  candidate.contradiction = evidence.matched > 0.0
                                ? (evidence.matched - evidence.total()) / evidence.matched
                                : std::numeric_limits<double>::infinity();
}

}  // namespace

void Initializer::Workspace::assess(const TiledCloud& cloud,
                                    const std::vector<Hypothesis>& hypotheses,
                                    const Selection& ranked, std::vector<Candidate>& answers) {
  for (const Hypothesis& hypothesis : best_apart(hypotheses, ranked, extent)) {
    if (hypothesis.score <= 0.0) continue;
    Configuration configuration = hypothesis.configuration;
    resolve_overlap(cloud, variables, {}, configuration);
    align_exactly(cloud, configuration);
    const auto& result = align_finely(cloud, configuration, {0.0, 0});
    Candidate candidate;
    candidate.configuration = configuration;
    set_evidence(verifier.evidence(configuration), candidate);
    candidate.agreement = result.agreement;
    answers.push_back(std::move(candidate));
  }
  sort_best_first(answers);
  compare(extent, symmetries, answers);
}

}  // namespace lockbox
