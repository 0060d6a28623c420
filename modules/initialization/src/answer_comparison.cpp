// SPDX-License-Identifier: BSD-3-Clause
#include "answer_comparison.hpp"

#include <algorithm>
#include <cstddef>

namespace lockbox {
namespace {

/// Of 250 right answers none had a rival elsewhere that scored more than 0.975 times as much, and
/// of two places that explain a view alike the wrong one won by a hundredth.
constexpr double kNearlyAsConvincing = 0.98;
/// Where the best one says no more than wrong ones may: of 28 right answers that score less than
/// kPossible five have a rival with 0.75 of it, of three wrong ones all.
constexpr double kNotMuchLess = 0.75;

/// Of the evidence that another answer has: the same, but for chance. (With 0.95 a cabinet upside
/// down, the second best of two wrong answers by 0.979, was convincing enough to end the search.)
constexpr double kAsMuch = 0.99;

/// Whether most of the pixels that either explains are the same.
bool explain_the_same(const Answer& a, const Answer& b) {
  std::size_t by_a = 0;
  std::size_t by_b = 0;
  std::size_t by_both = 0;
  for (std::size_t i = 0; i < a.explained.size(); ++i) {
    by_a += a.explained[i];
    by_b += b.explained[i];
    by_both += a.explained[i] & b.explained[i];
  }
  return 2 * by_both > std::max(by_a, by_b);
}

/// Near each other, or turned to where a symmetric part looks the same: a cube with something
/// beside it, which only one of the turns explains, too.
bool compete(const Answer& a, const Answer& b, const ModelLevers& levers) {
  return place_distance(levers, a.candidate.configuration, b.candidate.configuration) <
             kSamePlace ||
         explain_the_same(a, b);
}

/// Moves the last one before the first of those that compete with it, explain no more but for
/// chance, and convince less.
void put_before_less_convincing(std::vector<Answer>::iterator first,
                                std::vector<Answer>::iterator last, const ModelLevers& levers) {
  const auto worse = std::find_if(first, last, [&](const Answer& other) {
    return last->total >= kAsMuch * other.total && last->candidate.score > other.candidate.score &&
           compete(other, *last, levers);
  });
  std::rotate(worse, last, last + 1);
}

double least_score_of_rivals(double best) {
  return (best < kPossible ? kNotMuchLess : kNearlyAsConvincing) * best;
}

}  // namespace

void sort_best_first(std::vector<Answer>& answers, const ModelLevers& levers) {
  std::stable_sort(answers.begin(), answers.end(),
                   [](const Answer& a, const Answer& b) { return a.total > b.total; });
  for (auto answer = answers.begin(); answer != answers.end(); ++answer) {
    put_before_less_convincing(answers.begin(), answer, levers);
  }
  for (auto answer = answers.begin(); answer != answers.end(); ++answer) {
    const auto best_there = std::find_if(answers.begin(), answer, [&](const Answer& other) {
      return compete(other, *answer, levers);
    });
    if (best_there->total > answer->total) {
      const double share = best_there->total != 0.0 ? answer->total / best_there->total : 1.0;
      answer->candidate.score = best_there->candidate.score * share;
    }
  }
  std::stable_sort(answers.begin(), answers.end(), [](const Answer& a, const Answer& b) {
    return a.candidate.score > b.candidate.score;
  });
}

double rival_distance(const std::vector<Answer>& answers, const ModelLevers& levers) {
  const Answer& best = answers.front();
  const auto rival = std::find_if(answers.begin() + 1, answers.end(), [&](const Answer& other) {
    return !compete(best, other, levers);
  });
  if (rival == answers.end() ||
      rival->candidate.score < least_score_of_rivals(best.candidate.score)) {
    return 0.0;
  }
  return (best.candidate.configuration.T_camera_base.translation() -
          rival->candidate.configuration.T_camera_base.translation())
      .norm();
}

}  // namespace lockbox
