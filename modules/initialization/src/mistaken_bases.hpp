// SPDX-License-Identifier: BSD-3-Clause
// The halves of a laptop, the links of a chain: what is taken for the base may be another body of
// its size.
#pragma once

#include <vector>

#include "sought_model.hpp"

namespace lockbox {

/// The answer with the base where another body of its size is, and with such a body where the base
/// is; all joints as in `held`.
std::vector<Hypothesis> with_base_mistaken(const SoughtModel& sought, const Configuration& held,
                                           const Configuration& answer);

}  // namespace lockbox
