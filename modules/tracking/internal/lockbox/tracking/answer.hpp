// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "lockbox/registration/articulated_registration.hpp"

namespace lockbox {

/// Where the object may be in one frame: what an alignment has found, and what searches and the
/// image tell of it beside that. A search that doubts an answer enlarges its standard deviations,
/// and counts joints as not observable.
struct Answer : RegistrationResult {
  Answer() = default;
  /// Implicit: an alignment is an answer of which nothing else is known.
  Answer(RegistrationResult found) : RegistrationResult(std::move(found)) {}

  /// Metres to where the base may be as well, if a search of the whole view could not tell; else 0.
  double rival_distance = 0.0;
  /// The probability that this is the object, where the image was asked for it; else 0.
  double belief = 0.0;
};

}  // namespace lockbox
