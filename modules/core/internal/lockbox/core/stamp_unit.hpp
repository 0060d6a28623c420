// SPDX-License-Identifier: BSD-3-Clause
// Timestamps that are not in seconds, as they ought to be.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lockbox {

struct StampUnit {
  double per_second;  ///< 1e3, 1e6 or 1e9
  std::string name;   ///< `milliseconds`, `microseconds`, `nanoseconds`
  bool certain;       ///< false: so many seconds are possible, too, but improbable
};

/// The unit that stamps must be in for a recording of depth images; nothing if they are plausible
/// as seconds. It follows from their size if they count from 1970, else from the median of what
/// consecutive ones differ by. Only milliseconds that do not count from 1970 are uncertain.
std::optional<StampUnit> other_stamp_unit(const std::vector<double>& stamps);

}  // namespace lockbox
