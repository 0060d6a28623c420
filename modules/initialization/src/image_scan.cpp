// SPDX-License-Identifier: BSD-3-Clause
#include "image_scan.hpp"

#include "lockbox/initialization/initializer.hpp"

namespace lockbox {
namespace {

constexpr double kDoubt = 5.0;  // pixels: that two positions may differ by without telling

}  // namespace

void scan_by_image(LowProminence& low_prominence, const TiledCloud& cloud,
                   const std::vector<int>& variables, std::vector<double>& margins,
                   const StopRequest& stop_request, Configuration& configuration) {
  for (const int variable : variables) {
    stop_if(stop_request);
    const bool is_told =
        margins[static_cast<std::size_t>(variable)] > kDoubt &&
        low_prominence.prominence(variable, configuration) > LowProminence::kSurelyStandsOut;
    if (is_told) continue;
    const auto match = low_prominence.find_anywhere(cloud, configuration, variable);
    if (match.better) configuration.q[variable] = match.better->position;
    if (!match.is_told) margins[static_cast<std::size_t>(variable)] = kNotTold;
  }
}

}  // namespace lockbox
