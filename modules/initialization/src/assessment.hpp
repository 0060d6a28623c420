// SPDX-License-Identifier: BSD-3-Clause
// What the image says for hypotheses against the scene without the object: which are worth being
// followed, and which answer is the most convincing (docs/initialization.md).
#pragma once

#include <vector>

#include "exact_fit.hpp"
#include "lockbox/verification/verifier.hpp"
#include "search_image.hpp"

namespace lockbox {

/// Not thread-safe. What is sought, and the fit, must outlive it.
class Assessment {
 public:
  Assessment(const SoughtModel& sought, const SensorNoise& sensor, ExactFit& exact);

  /// The image that evidence is sought in from now on.
  void look_at(const SearchImage& image, const Executor& executor);

  /// What the image says for it, nats.
  double evidence(const Configuration& configuration) {
    return verifier_.evidence(configuration).total();
  }

  /// A drawing takes a table for the tray that slides out just above it; the image sees through
  /// that. Where what is seen through costs more than any place, joints that were sought go back,
  /// one by one, to where they stand in `held`, if the image says more for it.
  void put_back_joints(const Configuration& held, std::vector<Hypothesis>& hypotheses);

  /// What follows costs most, and cannot make an answer of what the image says too little for.
  /// to_beat: the most evidence of any answer up to now; gain: the most that evidence grows by from
  /// here on; nats.
  void leave_out_hopeless(double to_beat, double gain, std::size_t most,
                          std::vector<Hypothesis>& hypotheses);

  /// Adds the hypotheses, made exact, to the answers, the most convincing first.
  void add_answers(SearchImage& image, const std::vector<Hypothesis>& hypotheses,
                   const Selection& ranked, std::vector<Candidate>& answers);

  /// What no image tells from the best answer, as it is.
  void add_look_alikes(const TiledCloud& cloud, std::vector<Candidate>& answers);

  /// Compares the best answer closer with others in its place that are nearly as good, which may be
  /// as good then. No answer becomes more certain by that: the right one may not be among them.
  void compare_closely(const TiledCloud& cloud, const Executor& executor,
                       std::vector<Candidate>& answers);

 private:
  void put_back_joints(const Configuration& held, Configuration& configuration);

  const SoughtModel& sought_;
  SensorNoise sensor_;
  ExactFit& exact_;
  Verifier verifier_;
};

}  // namespace lockbox
