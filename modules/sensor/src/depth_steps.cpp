// SPDX-License-Identifier: BSD-3-Clause
#include "depth_steps.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "depth_bins.hpp"

namespace lockbox {
namespace {

/// Pixels, for a depth to be one that the sensor gives often: others lie apart because few pixels
/// are as far away. Doubled, steps at the far end of a room are not told.
constexpr std::size_t kFewestPixels = 8;
/// Depths of a bin, so that their distance is the sensor's, not that of two walls.
constexpr std::size_t kFewestDepths = 4;

struct Step {
  double length;  ///< metres, to the next depth
  std::size_t pixels;
};

double median_of(std::vector<Step>& steps) {
  std::sort(steps.begin(), steps.end(),
            [](const Step& a, const Step& b) { return a.length < b.length; });
  std::size_t all = 0;
  for (const Step& step : steps) all += step.pixels;
  std::size_t below = 0;
  for (const Step& step : steps) {
    below += step.pixels;
    if (2 * below >= all) return step.length;
  }
  return 0.0;
}

}  // namespace

std::array<double, NoiseRecord::kBins> depth_steps(const DepthFrame& frame) {
  std::vector<std::size_t> pixels_of(std::numeric_limits<std::uint16_t>::max() + 1U, 0);
  for (const std::uint16_t depth : frame.depth) ++pixels_of[depth];
  std::array<std::vector<Step>, NoiseRecord::kBins> steps;
  std::optional<double> before;  // metres, of the depth that is given often
  for (std::size_t depth = 1; depth < pixels_of.size(); ++depth) {
    const std::size_t pixels = pixels_of[depth];
    if (pixels < kFewestPixels) continue;
    const double z = static_cast<double>(depth) * static_cast<double>(frame.metres_per_unit);
    const auto bin = depth_bin(z);
    if (!bin) continue;
    if (before) steps[*bin].push_back({z - *before, pixels});
    before = z;
  }
  std::array<double, NoiseRecord::kBins> result{};
  std::transform(steps.begin(), steps.end(), result.begin(), [](std::vector<Step>& of_bin) {
    return of_bin.size() < kFewestDepths ? 0.0 : median_of(of_bin);
  });
  return result;
}

}  // namespace lockbox
