// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "fine_layout.hpp"
#include "lockbox/sdf/build_field.hpp"
#include "solid.hpp"

namespace lockbox {

struct FineGrid {
  FineLayout layout;
  std::vector<std::size_t> stored;  ///< numbers of the blocks, ascending

  double bytes() const;
};

/// For people: "3.5 mm", "12 m", three digits of a unit that suits, never an exponent.
std::string length_text(double metres);

/// With this voxel, and the band that the options ask for; nothing beyond the budget.
std::optional<FineGrid> refined_fine_grid(const Solid& solid, const FieldOptions& options,
                                          double voxel, const Executor& executor);

/// With the voxel and band that the options ask for, or with the finest that keep the budget.
/// Throws InputError for a field beyond 512 MB.
FineGrid choose_fine_grid(const Solid& solid, const FieldOptions& options,
                          const Executor& executor);

}  // namespace lockbox
