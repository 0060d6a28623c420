// SPDX-License-Identifier: BSD-3-Clause
// How much a neighbour that lies beyond an outline says of the outline's normal.
#pragma once

#include <array>
#include <cstdint>

#include "lockbox/kernels/outlines.hpp"

namespace lockbox::kernels {

struct PullTable {
  using Rows = std::array<std::array<std::int32_t, kPullColumns>, kPullRows>;
  Rows u{};
  Rows v{};

  constexpr PullTable() {
    for (int dv = -kPullReach; dv <= kPullReach; ++dv) {
      for (int du = -kPullReach; du <= kPullReach; ++du) {
        const int distance2 = du * du + dv * dv;
        if (distance2 == 0 || distance2 > kPullReach * kPullReach) continue;
        const auto row = static_cast<std::size_t>(dv + kPullReach);
        const auto column = static_cast<std::size_t>(du + kPullReach);
        u[row][column] = OutlinePull::kUnit * du / distance2;
        v[row][column] = OutlinePull::kUnit * dv / distance2;
      }
    }
  }
};

inline constexpr PullTable kPullTable;

}  // namespace lockbox::kernels
