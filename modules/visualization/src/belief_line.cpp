// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "lockbox/visualization/shown_estimate.hpp"

namespace lockbox {
namespace {

std::string percent(double share) {
  return std::to_string(std::lround(100.0 * share)) + " %";
}

}  // namespace

std::string alternative_name(const std::string& kind, double probability) {
  return kind + ' ' + percent(probability);
}

std::string belief_line(double belief, const std::string& alternatives) {
  std::string line = "belief " + percent(belief);
  std::istringstream stream(alternatives);
  std::string between = "; or ";
  for (std::string one; std::getline(stream, one, ';'); between = ", ") {
    const std::size_t colon = one.find(':');
    if (colon == std::string::npos) return line;
    line += between +
            alternative_name(one.substr(0, colon), std::strtod(one.c_str() + colon + 1, nullptr));
  }
  return line;
}

}  // namespace lockbox
