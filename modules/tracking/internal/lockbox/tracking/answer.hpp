// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "lockbox/registration/articulated_registration.hpp"

namespace lockbox {

/// Where the object may be in one frame: what an alignment has found, and what searches and the
/// image tell of it beside that. An alignment writes all fields of RegistrationResult, and nobody
/// else does, but for three of them:
/// - doubt_base(), and with it keep_doubts(), enlarges covariance and sigma of the base where a
///   search could not tell it from a rival;
/// - SizeRecord::add_misfit() enlarges covariance and sigma of all unknowns where the size does not
///   fit, just before the answer is classified and reported;
/// - Acquisition, and keep_doubts(), count joints as not observable where a search could not tell
///   where they are.
/// They are not kept apart from what the alignment said: whatever classifies an answer
/// (classification.hpp) goes by what is left after all doubts.
struct Answer : RegistrationResult {
  Answer() = default;
  /// Implicit: an alignment is an answer of which nothing else is known.
  Answer(RegistrationResult found) : RegistrationResult(std::move(found)) {}

  /// Metres to where the base may be as well, if a search of the whole view could not tell; else 0.
  /// Written by doubt_base().
  double rival_distance = 0.0;
  /// The probability that this is the object, where the image was asked for it; else 0. Written by
  /// Acquisition with what its search has found, and kept by ObjectSearch while that is brought up
  /// to date; by Tracker::Loop where an answer that is followed is doubted; by RivalComparison for
  /// the one that frames speak for.
  double belief = 0.0;
};

}  // namespace lockbox
