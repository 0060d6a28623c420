// SPDX-License-Identifier: BSD-3-Clause
#include "search_rounds.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "lockbox/verification/belief.hpp"
#include "turned_answers.hpp"

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

/// Turns of an answer are compared all of them, however much alike they look.
constexpr Selection kEachTurn{0.0, 128, 0.0, 1};
constexpr Breadth kOfTurns{1, kEachTurn, kEachTurn, kEachTurn, std::nullopt, 4, false};

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

/// What evidence gains at most from a pose in the coarse view to the exact one. Unit: nats.
/// Source: 187 was the most of 395 answers above 20 nats in 80 tuning scenes
/// (docs/initialization.md). Doubled, more hypotheses are followed that come to nothing.
constexpr double kGainedFromAfar = 200.0;
/// The same from an answer that is registered closely. Source: of the same answers three gained
/// more than 35 (39, 40 and 71), and stayed 272, 272 and 54 behind the best; one that led gained
/// 56. Doubled, more answers are made exact that are none.
constexpr double kGainedAtLast = 60.0;

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

SearchRounds::SearchRounds(const SoughtModel& sought, const InitializerOptions& options,
                           ExactFit& exact, const Executor& executor)
    : sought_(sought),
      most_candidates_(options.most_candidates),
      executor_(executor),
      exact_(exact),
      proposer_(sought, options.stop_request, executor),
      refinement_(sought, options, exact, executor),
      assessment_(sought, exact) {}

std::vector<Hypothesis> SearchRounds::proposed(SearchImage& image, const Configuration& held,
                                               const Round& round) {
  const Breadth& breadth = *round.breadth;
  switch (round.proposals) {
    case Proposals::sides:
      return proposer_.by_sides(image, image.scene(), held, breadth);
    case Proposals::sides_closer:
      return proposer_.by_sides(image, image.finer_scene(), held, breadth);
    case Proposals::points:
      break;
  }
  std::vector<Hypothesis> found = proposer_.by_points(image, held, breadth);
  // Bins are coarse: what they say is 15 degrees off, which one registration does not always mend.
  // Joints that stand elsewhere would pull the base away in it.
  if (sought_.variables.empty()) refinement_.place(image, breadth, found);
  return found;
}

std::vector<Hypothesis> SearchRounds::known(const std::vector<Configuration>& answers) const {
  std::vector<Hypothesis> hypotheses;
  hypotheses.reserve(answers.size());
  for (const Configuration& answer : answers) {
    hypotheses.push_back({answer, sought_.all_bodies, 1.0});
  }
  return hypotheses;
}

std::vector<Hypothesis> SearchRounds::followed(SearchImage& image,
                                               std::vector<Hypothesis> hypotheses,
                                               const Breadth& breadth, double to_beat) {
  const std::size_t most = breadth.likeliest;
  refinement_.place(image, breadth, hypotheses);
  refinement_.pose(image, breadth, hypotheses);
  assessment_.leave_out_hopeless(to_beat, kGainedFromAfar, most, hypotheses);
  refinement_.fit(image, breadth, hypotheses);
  assessment_.leave_out_hopeless(to_beat, kGainedFromAfar, most, hypotheses);
  refinement_.fit_closely(image, breadth, hypotheses);
  assessment_.leave_out_hopeless(to_beat, kGainedAtLast, most, hypotheses);
  return hypotheses;
}

/// Back to front or upside down, it may look nearly the same, and be passed over; and so may the
/// turns of what that finds, if it is an answer. turned: the evidence of the answer whose turns
/// were sought last.
void SearchRounds::seek_turns_of_best(SearchImage& image, const Configuration& held, double& turned,
                                      std::vector<Candidate>& answers) {
  do {
    if (answers.empty() || log_odds(answers.front().evidence, turned) <= kAnother) return;
    turned = answers.front().evidence;
    const Configuration best = answers.front().configuration;
    const RegistrationResult seen = exact_.compare(image.cloud(), best);
    std::vector<Hypothesis> others = turned_answers(sought_, held, best, seen.body_agreement);
    others = followed(image, std::move(others), kOfTurns, turned);
    assessment_.add_answers(image, others, kEachTurn, answers);
  } while (is_answer(answers));
}

std::vector<Candidate> SearchRounds::seek(SearchImage& image, const Configuration& held,
                                          int most_rounds, SearchProgress& progress) {
  assessment_.look_at(image, executor_);
  std::vector<Candidate> answers;
  assessment_.add_answers(image, known(progress.answers), kRanked, answers);
  double turned = -std::numeric_limits<double>::infinity();
  const std::span<const Round> rounds =
      sought_.is_flat ? std::span<const Round>(kFlatRounds) : kRoundRounds;
  bool is_convinced = false;
  for (int i = 0; i < most_rounds && !is_convinced && progress.rounds < std::ssize(rounds); ++i) {
    const Round& round = rounds[static_cast<std::size_t>(progress.rounds++)];
    std::vector<std::vector<Hypothesis>> batches = in_batches(proposed(image, held, round));
    for (std::vector<Hypothesis>& batch : batches) {
      const bool is_last = &batch == &batches.back();
      const double to_beat = answers.empty() ? least_evidence() : answers.front().evidence;
      const auto closer = followed(image, std::move(batch), *round.breadth, to_beat);
      assessment_.add_answers(image, closer, kRanked, answers);
      if (is_last || is_answer(answers)) seek_turns_of_best(image, held, turned, answers);
      is_convinced = !answers.empty() && is_clear(answers.front());
      if (is_convinced) break;
    }
    is_convinced |= !answers.empty() && answers.front().belief >= round.enough;
  }
  answers.resize(std::min(answers.size(), most_candidates_));
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
