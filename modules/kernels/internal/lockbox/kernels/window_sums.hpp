// SPDX-License-Identifier: BSD-3-Clause
// Many windows of maps of numbers, added up: the inner loop of a search over all shifts.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lockbox::kernels {

/// The columns of a result are computed in blocks of so many.
inline constexpr std::size_t kWindowBlock = 32;

/// Windows of one size in maps of one layout.
struct Windows {
  std::span<const std::int16_t* const> first;  ///< number of each window
  std::size_t next_row;                        ///< numbers from row to row of the maps
  std::size_t columns;                         ///< a multiple of kWindowBlock
  std::size_t rows;
};

/// sums: columns x rows. Sums that do not fit 16 bits wrap around.
void add_windows(const Windows& windows, std::int16_t* sums);

}  // namespace lockbox::kernels
