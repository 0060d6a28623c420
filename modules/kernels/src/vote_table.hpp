// SPDX-License-Identifier: BSD-3-Clause
// How much a neighbour that lies beyond a contour says of the contour's normal.
#pragma once

#include <array>
#include <cstdint>

#include "lockbox/kernels/contours.hpp"

namespace lockbox::kernels {

struct VoteTable {
  using Rows = std::array<std::array<std::int32_t, kVoteColumns>, kVoteRows>;
  Rows u{};
  Rows v{};

  constexpr VoteTable() {
    for (int dv = -kVoteReach; dv <= kVoteReach; ++dv) {
      for (int du = -kVoteReach; du <= kVoteReach; ++du) {
        const int distance2 = du * du + dv * dv;
        if (distance2 == 0 || distance2 > kVoteReach * kVoteReach) continue;
        const auto row = static_cast<std::size_t>(dv + kVoteReach);
        const auto column = static_cast<std::size_t>(du + kVoteReach);
        u[row][column] = NormalVote::kUnit * du / distance2;
        v[row][column] = NormalVote::kUnit * dv / distance2;
      }
    }
  }
};

inline constexpr VoteTable kVoteTable;

}  // namespace lockbox::kernels
