// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox {

/// What an image says for a configuration against the scene as it would be without the object: the
/// logarithm of a likelihood ratio, in nats, and what it is made of (docs/verification.md).
struct Evidence {
  double matched = 0.0;               ///< of contours that the scene has where the model has them
  double contradicted = 0.0;          ///< of contours that only one of the two has
  double misfit = 0.0;                ///< of surfaces that are not quite where the model shows them
  double free_space_violation = 0.0;  ///< of what was seen behind the model, through it
  double occluded = 0.0;              ///< of what stands before it
  int cells = 0;                      ///< that show the model, and in which something was measured

  Evidence& operator+=(const Evidence& other) {
    matched += other.matched;
    contradicted += other.contradicted;
    misfit += other.misfit;
    free_space_violation += other.free_space_violation;
    occluded += other.occluded;
    cells += other.cells;
    return *this;
  }

  double total() const { return matched + contradicted + misfit + free_space_violation + occluded; }
};

}  // namespace lockbox
