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
    8, {0.1, 96, 0.5, 16}, {0.1, 40, 0.5, 8}, {0.15, 8, 0.5, 2}, std::nullopt, false};
constexpr Breadth kWide{32,
                        {0.03, 400, 0.5, 64},
                        {0.03, 120, 0.5, 16},
                        {0.02, 24, 0.5, 4},
                        Selection{0.02, 48, 0.5, 8},
                        false};
/// Of points, which propose many places that look alike from afar, of things that are mostly small.
constexpr Breadth kOfPoints{
    8, {0.03, 128, 0.5, 16}, {0.03, 64, 0.5, 12}, {0.05, 16, 0.5, 4}, std::nullopt, true};

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

std::vector<Candidate> Initializer::Workspace::seek_in_rounds(const TiledCloud& cloud,
                                                              const PlanarScene& scene,
                                                              const CoarseView& fine_view,
                                                              int most_rounds,
                                                              SearchProgress& progress) {
  std::vector<Candidate> answers;
  assess(cloud, known(progress.answers), kRanked, answers);
  double most_evidence = -std::numeric_limits<double>::infinity();
  const std::span<const Round> rounds =
      is_flat ? std::span<const Round>(kFlatRounds) : kRoundRounds;
  bool is_convinced = false;
  for (int i = 0; i < most_rounds && !is_convinced && progress.rounds < std::ssize(rounds); ++i) {
    const Round& round = rounds[static_cast<std::size_t>(progress.rounds++)];
    assess(cloud, followed(cloud, proposed(round, scene, fine_view), *round.breadth), kRanked,
           answers);
    if (answers.empty()) continue;
    // Back to front or upside down, it may look nearly the same, and be passed over; and so may the
    // turns of what that finds.
    while (log_odds(answers.front().evidence, most_evidence) > kAnother) {
      most_evidence = answers.front().evidence;
      assess(cloud, seek_turned(cloud, answers.front().configuration), kEachTurn, answers);
    }
    is_convinced = answers.front().belief >= round.enough;
  }
  answers.resize(std::min(answers.size(), options.most_candidates));
  progress.answers.clear();
  if (is_convinced || progress.rounds == std::ssize(rounds)) {
    progress.rounds = 0;
  } else {
    for (const Candidate& answer : answers) progress.answers.push_back(answer.configuration);
  }
  return answers;
}

}  // namespace lockbox
