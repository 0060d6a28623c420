// SPDX-License-Identifier: BSD-3-Clause
#include "outline_continuation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lockbox {
namespace {

constexpr int kStretch = 8;            // pixels along each side of what makes a stretch of outline
constexpr double kFarBehind = 6.0;     // standard deviations: more says no more
constexpr double kOutlinePrior = 8.0;  // outline pixels that would have to be seen to matter
// What should be seen inside of an outline and was not measured, nor farther in: next to a shadow
// or to an empty background, an outline could otherwise be imagined anywhere. It counts for so much
// of one beyond which the surface goes on.
constexpr double kUnseen = 0.5;

constexpr std::array<std::array<int, 2>, 4> kNeighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// Pixels of the outline that are near each other and face the same way.
struct Stretch {
  double sum = 0.0;  ///< of how much nearer the surface beyond is, standard deviations
  double count = 0.0;
};

std::size_t stretch_index(const RenderedDepth& image, int u, int v, int du, int dv) {
  const int columns = image.width / kStretch + 1;
  const int direction = (du == 0 ? 2 : 0) + (du + dv > 0 ? 1 : 0);
  return static_cast<std::size_t>(4 * (v / kStretch * columns + u / kStretch) + direction);
}

bool is_measured(const CoarseView& view, int u, int v) {
  return view.contains(u, v) && view.depth[view.index(u, v)] > 0.0F;
}

}  // namespace

double share_that_continues(const RenderedDepth& image, const CoarseView& view, double noise,
                            double slack) {
  double unseen = 0.0;
  std::vector<Stretch> stretches(stretch_index(image, image.width, image.height, 1, 1) + 1);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const std::size_t here = image.index(u, v);
      if (image.id[here] == kNothing) continue;
      for (const auto& [du, dv] : kNeighbours) {
        if (!view.contains(u + du, v + dv) || image.id[image.index(u + du, v + dv)] != kNothing) {
          continue;
        }
        const double pixel_size = double{image.depth[here]} / view.camera.fx;
        const int reach = 1 + static_cast<int>(std::ceil(slack / pixel_size));
        const int in_u = u - reach * du;
        const int in_v = v - reach * dv;
        const int out_u = u + (reach + 1) * du;
        const int out_v = v + (reach + 1) * dv;
        if (!view.contains(in_u, in_v) || !view.contains(out_u, out_v)) continue;
        const std::size_t in = image.index(in_u, in_v);
        const std::size_t out = image.index(out_u, out_v);
        if (image.id[in] != image.id[here] || image.id[out] != kNothing) continue;
        const auto z_in = static_cast<double>(view.depth[in]);
        const auto z_out = static_cast<double>(view.depth[out]);
        if (!(z_in > 0.0) && !is_measured(view, u - 3 * reach * du, v - 3 * reach * dv)) {
          unseen += 1.0;
        }
        if (!(z_in > 0.0 && z_out > 0.0)) continue;
        const double w_here = 1.0 / double{image.depth[here]};
        const double w_in = 1.0 / double{image.depth[in]};
        const double off = std::abs(1.0 / z_in - w_in) / (w_in * w_in);
        if (off > 3.0 * (slack + noise / (w_in * w_in))) continue;  // not this surface's outline
        const double slope = (w_here - w_in) / reach;
        // How much nearer the measured surface is than its continuation, standard deviations.
        const double nearer =
            (1.0 / z_out - 1.0 / z_in - slope * (2.0 * reach + 1.0)) / (1.5 * noise);
        if (nearer > 2.0) continue;  // an occluder, or what the model stands on
        Stretch& stretch = stretches[stretch_index(image, u, v, du, dv)];
        stretch.sum += std::max(nearer, -kFarBehind);
        stretch.count += 1.0;
      }
    }
  }
  double continues = kUnseen * unseen;
  double ends = kOutlinePrior;
  for (const Stretch& stretch : stretches) {
    if (stretch.count == 0.0) continue;
    // Neighbours err alike, so that a mean is never better than that of a few.
    const double step = stretch.sum / stretch.count * std::sqrt(std::min(stretch.count, 4.0));
    const double same = std::exp(-0.5 * step * step);
    continues += same * stretch.count;
    ends += (1.0 - same) * stretch.count;
  }
  return continues / (continues + ends);
}

}  // namespace lockbox
