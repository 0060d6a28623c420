// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sought_model.hpp"

namespace lockbox {

/// The configurations in which one of the model's parts stands where the answer has another one
/// like it: a row of drawers may be the next one. held: in which joints stand that are still to be
/// sought; only base and that part are said to be known.
std::vector<Hypothesis> moved_along_twins(const SoughtModel& sought, const Configuration& held,
                                          const Configuration& answer);

}  // namespace lockbox
