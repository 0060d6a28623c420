// SPDX-License-Identifier: BSD-3-Clause
#include "stamps_in_seconds.hpp"

#include "lockbox/core/number_text.hpp"
#include "lockbox/core/stamp_unit.hpp"

namespace lockbox {

void bring_to_seconds(std::vector<double>& stamps, const std::string& where,
                      const std::function<void(const std::string&)>& warn) {
  const std::optional<StampUnit> unit = other_stamp_unit(stamps);
  if (!unit) {
    return;
  }
  const std::string factor = fixed_number_text(unit->per_second);
  if (!unit->certain) {
    if (warn) {
      warn(where +
           ": the timestamps are taken for seconds, and so the frames are far apart; if "
           "they are " +
           unit->name + ", divide them by " + factor);
    }
    return;
  }
  for (double& stamp : stamps) {
    stamp /= unit->per_second;
  }
  if (warn) {
    warn(where + ": the timestamps are taken for " + unit->name +
         ": in seconds they are divided by " + factor);
  }
}

}  // namespace lockbox
