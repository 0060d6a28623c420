// SPDX-License-Identifier: BSD-3-Clause
#include "search_rounds.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "base_scan.hpp"
#include "lockbox/verification/belief.hpp"
#include "rivals.hpp"
#include "turned_answers.hpp"

namespace lockbox {
namespace {

/// What a round keeps at first. Units are those of Breadth and Selection: numbers of hypotheses,
/// shares of the best score, radii of the model. Source: of those in a place and alike
/// docs/initialization.md, of the rest not recorded. Numbers doubled, a round takes up to twice as
/// long.
constexpr Breadth kUsual{
    .matches_each = 8,
    .matched = {.least_share = 0.1, .most = 96, .place = 0.5, .most_in_place = 16, .most_alike = 6},
    .placed = {.least_share = 0.1, .most = 40, .place = 0.5, .most_in_place = 16, .most_alike = 2},
    .posed = {.least_share = 0.15, .most = 16, .place = 0.5, .most_in_place = 8, .most_alike = 2},
    .improved = std::nullopt,
    .likeliest = 8,
    .is_close = false,
    .follows_again = false};
/// The same where that has found nothing that is possible. Source: in four of 500 scenes large
/// boxes kept a small block out before (docs/initialization.md, Rounds).
constexpr Breadth kWide{
    .matches_each = 32,
    .matched =
        {.least_share = 0.03, .most = 400, .place = 0.5, .most_in_place = 64, .most_alike = 24},
    .placed =
        {.least_share = 0.03, .most = 120, .place = 0.5, .most_in_place = 16, .most_alike = 6},
    .posed = {.least_share = 0.02, .most = 24, .place = 0.5, .most_in_place = 8, .most_alike = 2},
    .improved =
        Selection{
            .least_share = 0.02, .most = 48, .place = 0.5, .most_in_place = 8, .most_alike = 3},
    .likeliest = 8,
    .is_close = false,
    .follows_again = false};
/// Of points, which propose many places that look alike from afar, of things that are mostly small.
/// Source: not recorded.
constexpr Breadth kOfPoints{
    .matches_each = 8,
    .matched =
        {.least_share = 0.03, .most = 128, .place = 0.5, .most_in_place = 16, .most_alike = 16},
    .placed =
        {.least_share = 0.03, .most = 64, .place = 0.5, .most_in_place = 12, .most_alike = 12},
    .posed = {.least_share = 0.05, .most = 16, .place = 0.5, .most_in_place = 4, .most_alike = 4},
    .improved = std::nullopt,
    .likeliest = 8,
    .is_close = true,
    .follows_again = false};

/// Turns of an answer are compared all of them, however much alike they look.
constexpr Selection kEachTurn{
    .least_share = 0.0, .most = 128, .place = 0.0, .most_in_place = 1, .most_alike = 1};
/// Of these, those that are made exact. Source: not recorded. Doubled, eight are.
constexpr Breadth kOfTurns{.matches_each = 1,
                           .matched = kEachTurn,
                           .placed = kEachTurn,
                           .posed = kEachTurn,
                           .improved = std::nullopt,
                           .likeliest = 4,
                           .is_close = false,
                           .follows_again = true};

/// Log odds by which an answer is more than the one before made a little more exact.
constexpr double kAnother = 1.0;
/// Answers that are ranked, and those of them within a radius of the model of each other. Source:
/// not recorded.
constexpr Selection kRanked{
    .least_share = 0.0, .most = 32, .place = 1.0, .most_in_place = 8, .most_alike = 8};

/// What is believed less than this after the first round is sought closer, and what still is less
/// than this, with more of everything.
constexpr double kConvincing = 0.99999;
constexpr double kPossible = 0.99;
/// Hypotheses that are followed before all others. Source: in 78 of 88 tuning scenes the right one
/// is among them. Doubled, clear scenes take a quarter as long again.
constexpr std::size_t kFirst = 24;
/// Where the likeliest were followed before.
constexpr std::size_t kAllAtOnce = 0;
constexpr std::array<Round, 4> kFlatRounds{{{Proposals::sides, &kUsual, kFirst, kConvincing},
                                            {Proposals::sides_closer, &kUsual, kFirst, kPossible},
                                            {Proposals::points, &kOfPoints, kFirst, kPossible},
                                            {Proposals::all_sides, &kWide, kAllAtOnce, kPossible}}};
/// Of what is mostly round.
constexpr std::array<Round, 3> kRoundRounds{
    {{Proposals::sides, &kUsual, kFirst, kConvincing},
     {Proposals::points, &kOfPoints, kFirst, kPossible},
     {Proposals::points_of_others, &kOfPoints, kFirst, kPossible}}};

/// What may speak against an answer that is clear, of what speaks for it. Source: right answers of
/// tuning scenes have 0.01 to 0.28, wrong ones that do not look the same 0.6 and more; in a real
/// room a block has 0.15 with 33 nats, which evidence_beyond_a_box() keeps out. Doubled, wrong
/// answers may end a search of which a later batch has the right one.
constexpr double kClear = 0.25;
/// What evidence gains at most from a pose in the coarse view to the exact one. Unit: nats.
/// Source: 187 was the most of 395 answers above 20 nats in 80 tuning scenes
/// (docs/initialization.md). Doubled, more hypotheses are followed that come to nothing.
constexpr double kGainedFromAfar = 200.0;
/// The same from an answer that is registered closely. Source: of the same answers three gained
/// more than 35 (39, 40 and 71), and stayed 272, 272 and 54 behind the best; one that led gained
/// 56. Doubled, more answers are made exact that are none.
constexpr double kGainedAtLast = 60.0;

/// The likeliest first, if that many are to be.
std::vector<std::vector<Hypothesis>> in_batches(std::vector<Hypothesis> hypotheses,
                                                std::size_t first) {
  if (first == kAllAtOnce || hypotheses.size() <= first) return {std::move(hypotheses)};
  const auto middle = hypotheses.begin() + static_cast<std::ptrdiff_t>(first);
  std::vector<Hypothesis> others(std::make_move_iterator(middle),
                                 std::make_move_iterator(hypotheses.end()));
  hypotheses.resize(first);
  return {std::move(hypotheses), std::move(others)};
}

/// What has one body has no others.
std::span<const Round> rounds_of(const SoughtModel& sought) {
  if (sought.is_flat) return kFlatRounds;
  const std::span<const Round> rounds = kRoundRounds;
  return sought.model.tree.bodies.size() > 1 ? rounds : rounds.first(2);
}

/// Whether the best is more probable than none.
bool is_answer(const EvidenceOptions& options, const std::vector<Candidate>& answers) {
  return !answers.empty() && answers.front().evidence >= least_evidence(options);
}

/// Whether it is there, by more than a box can show, and hardly anything speaks against its being
/// just so.
bool is_clear(const EvidenceOptions& options, const Candidate& answer) {
  return answer.evidence >= evidence_beyond_a_box(options) && answer.contradiction <= kClear;
}

/// Whether the best is in its place, with so much belief, and hardly anything speaks against it: a
/// box that was taken for a press had 99 nats for it and 26 against it; the press itself, half
/// hidden, has 53. What hides most of an answer may be the object itself, elsewhere: of 157 right
/// answers of things of a household, of half of which a third is hidden, 0.44 was the most, and a
/// vise that was taken for the wrong end of itself had 0.52, with 81 nats of 265.
bool is_in_place(const SoughtModel& sought, const std::vector<Candidate>& answers, double enough) {
  if (answers.empty()) return false;
  const Agreement& best = answers.front().agreement;
  return answers.front().contradiction <= kClear && best.explained >= best.occluded &&
         belief_in_place_of_first(sought, answers) >= enough;
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
      assessment_(sought, options.registration.noise, exact) {}

std::vector<Hypothesis> SearchRounds::proposed(SearchImage& image, const Configuration& held,
                                               const Round& round) {
  const Breadth& breadth = *round.breadth;
  switch (round.proposals) {
    case Proposals::sides:
      return proposer_.by_sides(image, image.scene(), held, breadth);
    case Proposals::sides_closer:
      return proposer_.by_sides(image, image.finer_scene(), held, breadth);
    case Proposals::all_sides: {
      std::vector<Hypothesis> all = proposer_.by_sides(image, image.scene(), held, breadth);
      for (Hypothesis& closer : proposer_.by_sides(image, image.finer_scene(), held, breadth)) {
        all.push_back(std::move(closer));
      }
      return best_apart(std::move(all), breadth.matched, sought_.extent);
    }
    case Proposals::points_of_others:
      return proposer_.by_points_of_others(image, held, breadth);
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
                                               const Configuration& held, const Breadth& breadth,
                                               double to_beat) {
  const std::size_t most = breadth.likeliest;
  refinement_.place(image, breadth, hypotheses);
  refinement_.pose(image, breadth, hypotheses);
  if (!breadth.follows_again) leave_out_followed(hypotheses);
  assessment_.put_back_joints(held, hypotheses);
  assessment_.leave_out_hopeless(to_beat, kGainedFromAfar, most, hypotheses);
  posed_.insert(posed_.end(), hypotheses.begin(), hypotheses.end());
  refinement_.fit(image, breadth, hypotheses);
  assessment_.leave_out_hopeless(to_beat, kGainedFromAfar, most, hypotheses);
  refinement_.fit_closely(image, breadth, hypotheses);
  assessment_.leave_out_hopeless(to_beat, kGainedAtLast, most, hypotheses);
  return hypotheses;
}

/// Leaves out what was followed: from no better a start a hypothesis comes to no better an end.
void SearchRounds::leave_out_followed(std::vector<Hypothesis>& hypotheses) {
  std::erase_if(hypotheses, [&](const Hypothesis& hypothesis) {
    return std::any_of(posed_.begin(), posed_.end(), [&](const Hypothesis& before) {
      return before.score >= hypothesis.score && !are_apart(sought_.extent, before, hypothesis);
    });
  });
}

/// Back to front or upside down, it may look nearly the same, and be passed over; and so may the
/// turns of what that finds, if it is an answer. turned: the evidence of the answer whose turns
/// were sought last.
void SearchRounds::seek_turns_of_best(SearchImage& image, const Configuration& held, double& turned,
                                      std::vector<Candidate>& answers) {
  do {
    if (answers.empty() || log_odds(answers.front().evidence, turned, sought_.evidence) <= kAnother)
      return;
    turned = answers.front().evidence;
    const Configuration best = answers.front().configuration;
    std::vector<Hypothesis> turns = turned_answers(sought_, held, best);
    const RegistrationResult seen = exact_.compare(image.cloud(), best);
    for (Hypothesis& swung :
         with_base_swung(image, sought_, held, best, seen.body_agreement, executor_))
      turns.push_back(std::move(swung));
    for (std::vector<Hypothesis> others : {turns, turned_about_round(sought_, held, best)}) {
      if (others.empty()) continue;
      others = followed(image, std::move(others), held, kOfTurns, turned);
      assessment_.add_answers(image, others, kEachTurn, answers);
    }
  } while (is_answer(sought_.evidence, answers));
}

std::vector<Candidate> SearchRounds::seek(SearchImage& image, const Configuration& held,
                                          int most_rounds, SearchProgress& progress) {
  assessment_.look_at(image, executor_);
  posed_.clear();
  std::vector<Candidate> answers;
  assessment_.add_answers(image, known(progress.answers), kRanked, answers);
  double turned = -std::numeric_limits<double>::infinity();
  const std::span<const Round> rounds = rounds_of(sought_);
  bool is_convinced = false;
  for (int i = 0; i < most_rounds && !is_convinced && progress.rounds < std::ssize(rounds); ++i) {
    const Round& round = rounds[static_cast<std::size_t>(progress.rounds++)];
    std::vector<std::vector<Hypothesis>> batches =
        in_batches(proposed(image, held, round), round.first);
    for (std::vector<Hypothesis>& batch : batches) {
      const bool is_last = &batch == &batches.back();
      const double to_beat =
          answers.empty() ? least_evidence(sought_.evidence) : answers.front().evidence;
      const auto closer = followed(image, std::move(batch), held, *round.breadth, to_beat);
      assessment_.add_answers(image, closer, kRanked, answers);
      if (is_last || is_answer(sought_.evidence, answers))
        seek_turns_of_best(image, held, turned, answers);
      is_convinced = !answers.empty() && is_clear(sought_.evidence, answers.front());
      if (is_convinced) break;
    }
    is_convinced |= is_in_place(sought_, answers, round.enough);
  }
  progress.answers.clear();
  // What is merely possible is looked at closer in the next image.
  const bool is_over = !answers.empty() && (is_clear(sought_.evidence, answers.front()) ||
                                            is_in_place(sought_, answers, kConvincing));
  assessment_.add_look_alikes(image.cloud(), answers);
  assessment_.compare_closely(image.cloud(), executor_, answers);
  keep_most_apart(sought_, most_candidates_, answers);
  if (is_over || progress.rounds == std::ssize(rounds)) {
    progress.rounds = 0;
  } else {
    for (const Candidate& answer : answers) progress.answers.push_back(answer.configuration);
  }
  return answers;
}

}  // namespace lockbox
