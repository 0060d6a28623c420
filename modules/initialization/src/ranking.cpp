// SPDX-License-Identifier: BSD-3-Clause
// Which hypotheses the image says most for, and which answer is the most convincing
// (docs/initialization.md).
#include <algorithm>
#include <functional>
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

/// What follows costs most, and cannot make an answer of what the image says too little for.
void Initializer::Workspace::leave_out_hopeless(double to_beat, double gain, std::size_t most,
                                                std::vector<Hypothesis>& hypotheses) {
  std::vector<double> evidence;
  evidence.reserve(hypotheses.size());
  for (const Hypothesis& hypothesis : hypotheses) {
    evidence.push_back(verifier.evidence(hypothesis.configuration).total());
    to_beat = std::max(to_beat, evidence.back());
  }
  std::vector<double> least = evidence;
  std::sort(least.begin(), least.end(), std::greater<>());
  const double least_of_most =
      least.size() > most ? least[most - 1] : -std::numeric_limits<double>::infinity();
  std::size_t i = 0;
  std::erase_if(hypotheses, [&](const Hypothesis&) {
    const double here = evidence[i++];
    return here + gain < to_beat || here < least_of_most;
  });
}

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
