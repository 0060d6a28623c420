// SPDX-License-Identifier: BSD-3-Clause
#include "assessment.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "lockbox/verification/belief.hpp"
#include "rivals.hpp"

namespace lockbox {
namespace {

/// Of the best score, with which a hypothesis may be the right one but for some joints. Unit: 1.
/// Source: turned back to front, and its tray slid out, a printer scores as much as the right way
/// round; what scores half is elsewhere. Doubled, it would be for the best alone.
constexpr double kNearlyAsGood = 0.5;

/// Evidence by which a rival may be behind the best, and be as good by other cells. Unit: nats.
/// Source: nearly twice the 35 by which a right one was behind, and was not by narrower cells.
/// Doubled, more is compared that is far behind.
constexpr double kClose = 60.0;
/// So many of them are compared. Unit: answers. Source: not recorded. Doubled, comparisons take up
/// to twice as long.
constexpr std::size_t kMostRivals = 8;

void set_evidence(const Evidence& evidence, Candidate& candidate) {
  candidate.evidence = evidence.total();
  candidate.contradiction = evidence.matched > 0.0
                                ? (evidence.matched - evidence.total()) / evidence.matched
                                : std::numeric_limits<double>::infinity();
}

}  // namespace

Assessment::Assessment(const SoughtModel& sought, const SensorNoise& sensor, ExactFit& exact)
    : sought_(sought),
      sensor_(sensor),
      exact_(exact),
      verifier_(sought.model.tree, sought.evidence) {}

void Assessment::look_at(const SearchImage& image, const Executor& executor) {
  verifier_.look_at(image.cloud(), sensor_, executor);
}

void Assessment::put_back_joints(const Configuration& held, std::vector<Hypothesis>& hypotheses) {
  double best = 0.0;
  for (const Hypothesis& hypothesis : hypotheses) best = std::max(best, hypothesis.score);
  for (Hypothesis& hypothesis : hypotheses) {
    // Joints of a hypothesis that holds another body would move the base.
    if (hypothesis.held == 0 && hypothesis.score >= kNearlyAsGood * best)
      put_back_joints(held, hypothesis.configuration);
  }
}

void Assessment::put_back_joints(const Configuration& held, Configuration& configuration) {
  Evidence evidence = verifier_.evidence(configuration);
  for (const int variable : sought_.variables) {
    if (evidence.free_space_violation >= -least_evidence(sought_.evidence)) return;
    if (configuration.q[variable] == held.q[variable]) continue;
    Configuration other = configuration;
    other.q[variable] = held.q[variable];
    const Evidence there = verifier_.evidence(other);
    if (there.total() <= evidence.total()) continue;
    configuration = std::move(other);
    evidence = there;
  }
}

void Assessment::leave_out_hopeless(double to_beat, double gain, std::size_t most,
                                    std::vector<Hypothesis>& hypotheses) {
  std::vector<double> evidence;
  evidence.reserve(hypotheses.size());
  for (const Hypothesis& hypothesis : hypotheses) {
    evidence.push_back(verifier_.evidence(hypothesis.configuration).total());
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

void Assessment::add_answers(SearchImage& image, const std::vector<Hypothesis>& hypotheses,
                             const Selection& ranked, std::vector<Candidate>& answers) {
  for (const Hypothesis& hypothesis : best_apart(hypotheses, ranked, sought_.extent)) {
    if (hypothesis.score <= 0.0) continue;
    Candidate candidate;
    candidate.configuration = hypothesis.configuration;
    exact_.resolve_overlap(image.cloud(), sought_.variables, {}, candidate.configuration);
    exact_.refine(image, candidate.configuration);
    candidate.agreement = exact_.compare(image.cloud(), candidate.configuration).agreement;
    set_evidence(verifier_.evidence_within_tolerance(candidate.configuration), candidate);
    answers.push_back(std::move(candidate));
  }
  sort_best_first(answers);
  compare(sought_, answers);
}

void Assessment::add_look_alikes(const TiledCloud& cloud, std::vector<Candidate>& answers) {
  if (answers.empty()) return;
  const Configuration best = answers.front().configuration;
  for (Configuration& other : sought_.look_alikes->of(best)) {
    // One that the search has found by itself is not as exact.
    std::erase_if(answers, [&](const Candidate& answer) {
      return are_one(sought_, answer.configuration, other) &&
             !are_one(sought_, answer.configuration, best);
    });
    Candidate candidate;
    candidate.configuration = std::move(other);
    candidate.agreement = exact_.compare(cloud, candidate.configuration).agreement;
    set_evidence(verifier_.evidence_within_tolerance(candidate.configuration), candidate);
    answers.push_back(std::move(candidate));
  }
  sort_best_first(answers);
  compare(sought_, answers);
}

void Assessment::compare_closely(const TiledCloud& cloud, const Executor& executor,
                                 std::vector<Candidate>& answers) {
  std::vector<std::size_t> rivals;
  for (std::size_t i = 1; i < answers.size() && rivals.size() < kMostRivals; ++i) {
    if (answers[i].is_in_place_of_first && answers[i].evidence > answers[0].evidence - kClose &&
        !are_one(sought_, answers[0].configuration, answers[i].configuration))
      rivals.push_back(i);
  }
  if (rivals.empty()) return;
  std::vector<Configuration> compared{answers[0].configuration};
  for (const std::size_t i : rivals) compared.push_back(answers[i].configuration);
  const std::vector<double> nats = verifier_.compare(cloud, sensor_, executor, compared);
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    double& evidence = answers[rivals[i]].evidence;
    evidence =
        std::clamp(answers[0].evidence + nats[i + 1] - nats[0], evidence, answers[0].evidence);
  }
  sort_best_first(answers);
  compare(sought_, answers);
}

}  // namespace lockbox
