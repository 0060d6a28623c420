// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

namespace lockbox {

/// A joint that an estimate has in the wrong place.
struct WrongJoint {
  const char* name;
  double off;  ///< radians or metres
};

inline void PrintTo(const WrongJoint& joint, std::ostream* out) {
  *out << joint.name << " off by " << joint.off;
}

}  // namespace lockbox
