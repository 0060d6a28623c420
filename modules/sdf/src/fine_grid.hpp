// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "fine_layout.hpp"
#include "lockbox/sdf/build_field.hpp"
#include "solid.hpp"

namespace lockbox {

struct FineGrid {
  FineLayout layout;
  std::vector<std::size_t> stored;  ///< numbers of the blocks, ascending

  double bytes() const;
};

/// Chooses the grid with the voxel and band that the options ask for, or with the finest that keep
/// the budget. Throws InputError for a field beyond the memory limit, before its memory is taken.
FineGrid choose_fine_grid(const Solid& solid, const FieldOptions& options,
                          const Executor& executor);

/// Returns the grid with that voxel and the usual band; nothing if that exceeds the budget.
std::optional<FineGrid> grid_within_budget(const Solid& solid, double voxel,
                                           const FieldOptions& options, const Executor& executor);

}  // namespace lockbox
