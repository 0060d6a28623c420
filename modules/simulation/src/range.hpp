// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "lockbox/simulation/random_draws.hpp"

namespace lockbox::simulation {

struct Range {
  double low;
  double high;

  double draw(RandomDraws& random) const { return random.uniform(low, high); }
};

/// A whole number from low to high, both included.
inline int draw_number(RandomDraws& random, int low, int high) {
  return std::min(high, static_cast<int>(random.uniform(low, high + 1)));
}

}  // namespace lockbox::simulation
