// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/tracking/answer.hpp"
#include "lockbox/tracking/tracker_options.hpp"

namespace lockbox {

/// The alignments of one frame, one after the other until nothing moves any more. Gates stay as
/// narrow as motion is known: wide ones drag parts onto each other, many steps do not. All that is
/// given must outlive it.
class FrameAlignment {
 public:
  /// annealing_sigma: how far surfaces may be from where they are predicted, metres.
  FrameAlignment(ArticulatedRegistration& registration, const TiledCloud& cloud,
                 const TrackerOptions& options, double annealing_sigma);

  /// Aligns once. is_predicted: see AlignOptions.
  Answer once(const Configuration& prediction, bool is_predicted);

  /// Goes on from an answer, which was aligned from start, until it rests.
  Answer until_rest(const Configuration& start, const Answer& aligned);

  /// Goes on from where an alignment of this frame has ended, until it rests.
  Answer followed(const Configuration& start);

  /// While the base was on its way, parts were dragged along by whatever lay near. They start anew
  /// as predicted, from where the base of the best answer is now; of two answers that explain the
  /// image, the new one is the likelier one.
  void carry_parts(const Configuration& prediction, Answer& best);

 private:
  AlignOptions further() const;
  bool is_on_its_way(const Configuration& start, const Answer& result) const;

  ArticulatedRegistration& registration_;
  const TiledCloud& cloud_;
  const TrackerOptions& options_;
  double annealing_sigma_;
};

}  // namespace lockbox
