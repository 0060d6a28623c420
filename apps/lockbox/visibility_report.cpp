// SPDX-License-Identifier: BSD-3-Clause
#include "visibility_report.hpp"

#include <cmath>
#include <iostream>

namespace lockbox::app {

void VisibilityReport::Part::add(std::size_t frame, double share) {
  if (share < least) return;
  if (most == 0.0) first = frame;
  last = frame;
  if (share > most) {
    most = share;
    frame_of_most = frame;
  }
}

void VisibilityReport::Part::print(const std::string& what) const {
  if (most == 0.0) return;
  std::cerr << "lockbox: warning: " << what << " up to " << std::lround(100.0 * most)
            << " % of the object (";
  if (first == last) {
    std::cerr << "frame " << first << ")\n";
  } else {
    std::cerr << "most in frame " << frame_of_most << " of frames " << first << " to " << last
              << ")\n";
  }
}

void VisibilityReport::add(std::size_t frame, const State& state) {
  constexpr std::size_t kInterval = 5;
  if (frame % kInterval != 0) return;
  const ModelVisibility visibility = meter_.measure(state);
  cut_.add(frame, visibility.cut);
  hidden_.add(frame, visibility.hidden);
}

void VisibilityReport::print_warnings() const {
  cut_.print("the border of the image cuts off");
  hidden_.print("the scene hides");
}

}  // namespace lockbox::app
