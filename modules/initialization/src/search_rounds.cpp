// SPDX-License-Identifier: BSD-3-Clause
// The rounds of the search without a guess (docs/initialization.md): each looks closer than those
// before, and is left out where these have convinced.
#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "lockbox/verification/belief.hpp"
#include "search_workspace.hpp"

namespace lockbox {
namespace {

constexpr Breadth kUsual{
    8, {0.1, 96, 0.5, 16}, {0.1, 40, 0.5, 8}, {0.15, 8, 0.5, 2}, std::nullopt, 8, false};
constexpr Breadth kWide{32,
                        {0.03, 400, 0.5, 64},
                        {0.03, 120, 0.5, 16},
                        {0.02, 24, 0.5, 4},
                        Selection{0.02, 48, 0.5, 8},
                        8,
                        false};
/// Of points, which propose many places that look alike from afar, of things that are mostly small.
constexpr Breadth kOfPoints{
    8, {0.03, 128, 0.5, 16}, {0.03, 64, 0.5, 12}, {0.05, 16, 0.5, 4}, std::nullopt, 8, true};

/// Log odds by which an answer is more than the one before made a little more exact.
constexpr double kAnother = 1.0;
constexpr Selection kRanked{0.0, 32, 1.0, 8};

/// What is believed less than this after the first round is sought closer, and what still is less
/// than this, with more of everything.
constexpr double kConvincing = 0.99999;
constexpr double kPossible = 0.99;
constexpr std::array<Round, 5> kFlatRounds{{{Proposals::sides, &kUsual, kConvincing},
                                            {Proposals::sides_closer, &kUsual, kPossible},
                                            {Proposals::points, &kOfPoints, kPossible},
                                            {Proposals::sides, &kWide, kPossible},
                                            {Proposals::sides_closer, &kWide, kPossible}}};
/// Of what is mostly round.
constexpr std::array<Round, 2> kRoundRounds{
    {{Proposals::sides, &kUsual, kConvincing}, {Proposals::points, &kOfPoints, kPossible}}};

/// Hypotheses that are followed before all others. Source: in 78 of 88 tuning scenes the right one
/// is among them. Doubled, clear scenes take a quarter as long again.
constexpr std::size_t kFirst = 24;
/// What may speak against an answer that is clear, of what speaks for it. Source: right answers of
/// tuning scenes have 0.01 to 0.28, wrong ones that do not look the same 0.6 and more; in a real
/// room a block has 0.15 with 33 nats, which kBeyondChance keeps out. Doubled, wrong answers may
/// end a search of which a later batch has the right one.
constexpr double kClear = 0.25;
/// The evidence of an answer that is clear, of that with which an answer is as probable as none.
/// Source: in rooms without the object 2.5 were the most (docs/verification.md). Doubled, small
/// objects are sought to the end.
constexpr double kBeyondChance = 3.0;

/// The likeliest first.
std::vector<std::vector<Hypothesis>> in_batches(std::vector<Hypothesis> hypotheses) {
  std::vector<std::vector<Hypothesis>> batches(hypotheses.size() > kFirst ? 2 : 1);
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    batches[i < kFirst ? 0 : 1].push_back(std::move(hypotheses[i]));
  }
  return batches;
}

/// Whether the best is more probable than none.
bool is_answer(const std::vector<Candidate>& answers) {
  return !answers.empty() && answers.front().evidence >= least_evidence();
}

/// Whether it is there, and hardly anything speaks against its being just so.
bool is_clear(const Candidate& answer) {
  return answer.evidence >= kBeyondChance * least_evidence() && answer.contradiction <= kClear;
}

}  // namespace

std::vector<Hypothesis> Initializer::Workspace::proposed(const Round& round,
                                                         const PlanarScene& scene,
                                                         const CoarseView& fine_view) {
  switch (round.proposals) {
    case Proposals::sides:
      return match(scene, *round.breadth);
    case Proposals::sides_closer:
      return match(find_planes(fine_view, fine_view_noise()), *round.breadth);
    case Proposals::points:
      break;
  }
  return match_points(fine_view, scene, *round.breadth);
}

/// Back to front or upside down, it may look nearly the same, and be passed over; and so may the
/// turns of what that finds, if it is an answer. turned: the evidence of the answer whose turns
/// were sought last.
void Initializer::Workspace::seek_turns_of_best(const TiledCloud& cloud, double& turned,
                                                std::vector<Candidate>& answers) {
  do {
    if (answers.empty() || log_odds(answers.front().evidence, turned) <= kAnother) return;
    turned = answers.front().evidence;
    assess(cloud, seek_turned(cloud, answers.front()), kEachTurn, answers);
  } while (is_answer(answers));
}

std::vector<Candidate> Initializer::Workspace::seek_in_rounds(const TiledCloud& cloud,
                                                              const PlanarScene& scene,
                                                              const CoarseView& fine_view,
                                                              int most_rounds,
                                                              SearchProgress& progress) {
  std::vector<Candidate> answers;
  assess(cloud, known(progress.answers), kRanked, answers);
  double turned = -std::numeric_limits<double>::infinity();
  const std::span<const Round> rounds =
      is_flat ? std::span<const Round>(kFlatRounds) : kRoundRounds;
  bool is_convinced = false;
  for (int i = 0; i < most_rounds && !is_convinced && progress.rounds < std::ssize(rounds); ++i) {
    const Round& round = rounds[static_cast<std::size_t>(progress.rounds++)];
    std::vector<std::vector<Hypothesis>> batches = in_batches(proposed(round, scene, fine_view));
    for (std::vector<Hypothesis>& batch : batches) {
      const bool is_last = &batch == &batches.back();
      const double to_beat = answers.empty() ? least_evidence() : answers.front().evidence;
      assess(cloud, followed(cloud, std::move(batch), *round.breadth, to_beat), kRanked, answers);
      if (is_last || is_answer(answers)) seek_turns_of_best(cloud, turned, answers);
      is_convinced = !answers.empty() && is_clear(answers.front());
      if (is_convinced) break;
    }
    is_convinced |= !answers.empty() && answers.front().belief >= round.enough;
  }
  answers.resize(std::min(answers.size(), options.most_candidates));
  progress.answers.clear();
  // What is merely possible is looked at closer in the next image.
  const bool is_over =
      !answers.empty() && (is_clear(answers.front()) || answers.front().belief >= kConvincing);
  if (is_over || progress.rounds == std::ssize(rounds)) {
    progress.rounds = 0;
  } else {
    for (const Candidate& answer : answers) progress.answers.push_back(answer.configuration);
  }
  return answers;
}

}  // namespace lockbox
