// SPDX-License-Identifier: BSD-3-Clause
#include "rival_comparison.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "lockbox/solver/motion_metric.hpp"
#include "lockbox/verification/belief.hpp"

namespace lockbox {
namespace {

/// Their noise may favour what is wrong in one; it is not the same in all. What is off in the model
/// is: so many frames are no more evidence than one without noise. Unit: frames. Source: of the
/// real cube and dragon sixteen frames in a row speak for what is right. Doubled, what is sure is
/// reported so late.
constexpr int kFrames = 3;
/// Of the way from one of them to another: what is nearer to one is that one. Unit: 1. Doubled,
/// answers between two would be.
constexpr double kNearer = 0.5;

}  // namespace

bool RivalComparison::has_ended() const {
  return rivals_.empty() || frames_ >= ends_at_;
}

std::optional<RivalComparison::Doubt> RivalComparison::begin(
    const Answer& answer, const std::vector<Alternative>& rivals) {
  if (goes_on(answer)) {
    const std::vector<double> means = mean_evidence();
    double nearest = std::numeric_limits<double>::infinity();
    for (const Rival& rival : rivals_)
      nearest =
          std::min(nearest, registration_.moves().between(answer.at_rest, rival.answer.at_rest));
    return Doubt{belief(means.front(), std::span(means).subspan(1), options_.evidence), nearest};
  }
  rivals_.clear();
  followed_ = {};
  frames_ = 0;
  ends_at_ = kFrames;
  if (!(answer.rival_distance > 0.0))
    return std::nullopt;  // the rivals are those of an earlier answer
  double told = answer.belief;
  for (const Alternative& rival : rivals) told += rival.probability;
  if (told < options_.convincing_belief) return std::nullopt;
  for (const Alternative& rival : rivals) {
    rivals_.emplace_back().answer.at_rest = rival.configuration;
  }
  return std::nullopt;
}

/// Whether it is what was followed, or one of the rivals: they change places then. It is the
/// nearest of them if it is less than half of the way from there to any other.
bool RivalComparison::goes_on(const Answer& answer) {
  if (rivals_.empty() || frames_ == 0) return false;
  const auto distance = [&](const Rival& a, const Configuration& b) {
    return registration_.moves().between(a.answer.at_rest, b);
  };
  std::vector<Rival*> all{&followed_};
  for (Rival& rival : rivals_) all.push_back(&rival);
  Rival& nearest = **std::ranges::min_element(
      all, {}, [&](const Rival* each) { return distance(*each, answer.at_rest); });
  const double here = distance(nearest, answer.at_rest);
  for (const Rival* other : all) {
    if (other != &nearest && here >= kNearer * distance(*other, nearest.answer.at_rest))
      return false;
  }
  std::swap(nearest, followed_);
  ends_at_ = frames_ + kFrames;
  return true;
}

std::vector<double> RivalComparison::mean_evidence() const {
  std::vector<double> means{followed_.evidence / frames_};
  for (const Rival& rival : rivals_) means.push_back(rival.evidence / frames_);
  return means;
}

std::optional<RivalComparison::Outcome> RivalComparison::compare(const Answer& followed) {
  const AlignOptions narrow{options_.start_joint_sigma, options_.start_joint_iterations};
  std::vector<Configuration> configurations{followed.configuration};
  for (Rival& rival : rivals_) {
    rival.answer = registration_.align(cloud_, rival.answer.at_rest, narrow);
    configurations.push_back(rival.answer.configuration);
  }
  const std::vector<double> evidence = image_belief_.evidence(configurations);
  ++frames_;
  followed_.answer = followed;
  followed_.evidence += evidence.front();
  for (std::size_t i = 0; i < rivals_.size(); ++i) rivals_[i].evidence += evidence[i + 1];
  // What has come to the same rest is no rival any more.
  std::erase_if(rivals_, [&](const Rival& rival) {
    return registration_.moves().between(rival.answer.at_rest, followed.at_rest) <=
           options_.most_rival_distance;
  });
  if (frames_ < ends_at_) return std::nullopt;
  std::vector<double> means = mean_evidence();
  const auto best = std::max_element(means.begin(), means.end());
  const auto number = static_cast<std::size_t>(best - means.begin());
  std::iter_swap(means.begin(), best);
  const double belief_in_best =
      belief(means.front(), std::span(means).subspan(1), options_.evidence);
  if (belief_in_best < options_.convincing_belief) return std::nullopt;
  Outcome outcome{number == 0 ? followed : rivals_[number - 1].answer, number > 0};
  outcome.answer.belief = belief_in_best;
  rivals_.clear();
  return outcome;
}

}  // namespace lockbox
