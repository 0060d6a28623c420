// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "lockbox/simulation/model_visibility.hpp"

namespace lockbox::app {

/// Measures how much of the model the frames of a simulation do not show, and warns of it.
class VisibilityReport {
 public:
  explicit VisibilityReport(VisibilityMeter meter) : meter_(std::move(meter)) {}

  /// Only one of a few frames is measured: shares change slowly.
  void add(std::size_t frame, const State& state);

  /// Prints them on standard error; nothing if it is little.
  void print_warnings() const;

 private:
  /// Frames in which the share was worth mentioning.
  struct Part {
    double least;  ///< share worth mentioning
    double most = 0.0;
    std::size_t frame_of_most = 0;
    std::size_t first = 0;
    std::size_t last = 0;

    void add(std::size_t frame, double share);
    void print(const std::string& what) const;
  };

  VisibilityMeter meter_;
  // Shares. A row of pixels less is no cut; an arm that reaches in is meant to hide something, but
  // twice as much and the object is hardly to be followed there.
  Part cut_{.least = 0.02};
  Part hidden_{.least = 0.25};
};

}  // namespace lockbox::app
