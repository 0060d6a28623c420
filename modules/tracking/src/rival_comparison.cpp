// SPDX-License-Identifier: BSD-3-Clause
#include "rival_comparison.hpp"

#include <algorithm>
#include <cstddef>

#include "lockbox/solver/motion_metric.hpp"
#include "lockbox/verification/belief.hpp"

namespace lockbox {
namespace {

/// Their noise may favour what is wrong in one; it is not the same in all. Unit: frames. Source: of
/// the real cube and dragon sixteen frames in a row speak for what is right. Doubled, what is sure
/// is reported so late.
constexpr int kFrames = 3;
/// So many of them err by themselves. Source: what speaks for the right answer there, beside a
/// turned one, scatters from frame to frame by 9.6 nats (24 in the mean), as much as is taken for
/// what one frame errs by: all of them. Of what is off in the model none would. Doubled, frames
/// that are all wrong alike are believed.
constexpr double kIndependentFrames = 2.0;

}  // namespace

bool RivalComparison::has_ended() const {
  return rivals_.empty() || frames_ >= kFrames;
}

void RivalComparison::begin(const Answer& answer, const std::vector<Alternative>& rivals) {
  rivals_.clear();
  frames_ = 0;
  evidence_ = 0.0;
  if (!(answer.rival_distance > 0.0)) return;  // the rivals are those of an earlier answer
  double told = answer.belief;
  for (const Alternative& rival : rivals) told += rival.probability;
  if (told < options_.convincing_belief) return;
  for (const Alternative& rival : rivals) {
    rivals_.emplace_back().answer.at_rest = rival.configuration;
  }
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
  evidence_ += evidence.front();
  for (std::size_t i = 0; i < rivals_.size(); ++i) rivals_[i].evidence += evidence[i + 1];
  // What has come to the same rest is no rival any more.
  std::erase_if(rivals_, [&](const Rival& rival) {
    return registration_.moves().between(rival.answer.at_rest, followed.at_rest) <=
           options_.most_rival_distance;
  });
  if (frames_ < kFrames) return std::nullopt;
  std::vector<double> means{evidence_ / frames_};
  for (const Rival& rival : rivals_) means.push_back(rival.evidence / frames_);
  const auto best = std::max_element(means.begin(), means.end());
  const auto number = static_cast<std::size_t>(best - means.begin());
  std::iter_swap(means.begin(), best);
  for (double& mean : means) mean = means.front() - kIndependentFrames * (means.front() - mean);
  const double belief_in_best =
      belief(means.front(), std::span(means).subspan(1), options_.evidence);
  if (belief_in_best < options_.convincing_belief) return std::nullopt;
  Outcome outcome{number == 0 ? followed : rivals_[number - 1].answer, number > 0};
  outcome.answer.belief = belief_in_best;
  rivals_.clear();
  return outcome;
}

}  // namespace lockbox
