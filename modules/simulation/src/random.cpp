// SPDX-License-Identifier: BSD-3-Clause
#include "random.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>

namespace lockbox::simulation {

NormalTable::NormalTable() {
  constexpr std::size_t kHalf = std::tuple_size_v<decltype(quantiles_)> / 2;
  std::array<double, kHalf> positive;
  double x = 0.0;
  double sum_of_squares = 0.0;
  for (std::size_t i = 0; i < kHalf; ++i) {
    const double beyond = 0.5 - (static_cast<double>(i) + 0.5) / (2.0 * kHalf);
    // Newton's method from the quantile before: the distribution is concave here, so it never
    // overshoots.
    for (int iteration = 0; iteration < 8; ++iteration) {
      const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
      x += (0.5 * std::erfc(x / std::numbers::sqrt2) - beyond) / density;
    }
    positive[i] = x;
    sum_of_squares += x * x;
  }
  const double scale = 1.0 / std::sqrt(sum_of_squares / kHalf);
  for (std::size_t i = 0; i < kHalf; ++i) {
    quantiles_[kHalf + i] = static_cast<float>(scale * positive[i]);
    quantiles_[kHalf - 1 - i] = -quantiles_[kHalf + i];
  }
}

}  // namespace lockbox::simulation
