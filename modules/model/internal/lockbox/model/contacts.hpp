// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

/// Up to this distance (metres) bodies touch; deeper ones overlap. What distance fields resolve.
inline constexpr double kContactTolerance = 2e-4;

struct Contact {
  std::size_t body_a;
  std::size_t body_b;
  double overlap;  ///< metres, median over the faces in contact; negative: a gap
};

/// All pairs of bodies that touch or overlap in the rest configuration.
std::vector<Contact> rest_contacts(const ArticulatedModel& model);

}  // namespace lockbox
