// SPDX-License-Identifier: BSD-3-Clause
// Brings an estimate and its reference to the same time, as far as they tell how.
#pragma once

#include <string>
#include <vector>

#include "lockbox/model/states_file.hpp"

namespace lockbox {

/// Converts stamps that are evidently not in seconds (core/stamp_unit.hpp; of milliseconds the
/// other file tells). Returns what was done, for people to read. Throws InputError(name, ...) if no
/// state of the reference has an estimate near in time (half a frame): then it is the truth of
/// another recording, or counts from another time.
std::vector<std::string> match_stamps(StatesFile& estimate, StatesFile& reference,
                                      const std::string& name);

/// Returns, of a reference that has more states than the estimate has in the same time, as motion
/// capture delivers them, the states nearest to an estimate; else all.
StatesFile at_times_of(const StatesFile& estimate, const StatesFile& reference);

}  // namespace lockbox
