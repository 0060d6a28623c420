// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fine_layout.hpp"
#include "lockbox/sdf/build_field.hpp"
#include "solid.hpp"

namespace lockbox {

struct FineGrid {
  FineLayout layout;
  std::vector<std::size_t> stored;  ///< numbers of the blocks, ascending

  double bytes() const;
};

/// "3.5 mm"
std::string millimetres(double metres);

/// With the voxel and band that the options ask for, or with the finest that keep the budget.
/// Throws InputError for a field beyond 512 MB.
FineGrid choose_fine_grid(const Solid& solid, const FieldOptions& options,
                          const Executor& executor);

}  // namespace lockbox
