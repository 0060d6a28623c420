// SPDX-License-Identifier: BSD-3-Clause
#include "contour_continuation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lockbox {
namespace {

constexpr int kStretch = 8;         // pixels along each side of what makes a stretch of contour
constexpr double kFarBehind = 6.0;  // standard deviations: more says no more
/// Times slack and noise that what is measured inside of a contour may be off, to be the surface
/// that ends there. Source: not recorded. Doubled, another surface as far off is taken for it.
constexpr double kOwnSurface = 3.0;
/// Standard deviations by which what is measured beyond a contour may be nearer than the surface's
/// continuation; what is nearer still occludes it, or is what the model stands on. Source: not
/// recorded. Doubled, more of the scene before the object counts as its end.
constexpr double kOccluder = 2.0;
/// Of noise, about, is the standard deviation of such a difference of two depths. Source: not
/// recorded. Doubled, a step must be twice as high to be an end.
constexpr double kNoiseOfStep = 1.5;
/// Neighbours err alike, so that the mean of a stretch is never better than that of so many pixels.
/// Source: not recorded. Doubled, long contours end at steps that are a third lower.
constexpr double kMostIndependent = 4.0;
constexpr double kContourPrior = 8.0;  // contour pixels that would have to be seen to matter
// What should be seen inside of a contour and was not measured, nor farther in: next to a shadow
// or to an empty background, a contour could otherwise be imagined anywhere. It counts for so much
// of one beyond which the surface goes on.
constexpr double kUnseen = 0.5;

/// (du, dv) from a pixel to those beside it.
constexpr std::array<std::array<int, 2>, 4> kNeighbours{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

/// Pixels of contours that are near each other and face the same way.
struct Stretch {
  double sum = 0.0;  ///< of how much nearer the surface beyond is, standard deviations
  double count = 0.0;
};

/// Rows or columns of stretches along so many pixels; the last may be a shorter one.
std::size_t stretches_along(int pixels) {
  return static_cast<std::size_t>((pixels + kStretch - 1) / kStretch);
}

std::size_t stretch_count(const RenderedDepth& image) {
  return kNeighbours.size() * stretches_along(image.width) * stretches_along(image.height);
}

/// direction: index into kNeighbours.
std::size_t stretch_index(const RenderedDepth& image, int u, int v, std::size_t direction) {
  const auto row = static_cast<std::size_t>(v / kStretch);
  const auto column = static_cast<std::size_t>(u / kStretch);
  return kNeighbours.size() * (row * stretches_along(image.width) + column) + direction;
}

bool is_measured(const CoarseView& view, int u, int v) {
  return view.contains(u, v) && view.depth[view.index(u, v)] > 0.0F;
}

/// Goes over the contour of what is drawn.
class ContourSurvey {
 public:
  ContourSurvey(const RenderedDepth& image, const CoarseView& view, double noise, double slack)
      : image_(image),
        view_(view),
        noise_(noise),
        slack_(slack),
        stretches_(stretch_count(image)) {}

  /// Looks from a pixel of what is drawn to its neighbour in that direction (index into
  /// kNeighbours), if the surface ends between them.
  void look_across(int u, int v, std::size_t direction) {
    const auto [du, dv] = kNeighbours[direction];
    if (!view_.contains(u + du, v + dv)) return;
    const std::size_t here = image_.index(u, v);
    const std::size_t next = image_.index(u + du, v + dv);
    if (image_.id[next] != kNothing) return;
    const double pixel_size = double{image_.depth[here]} / view_.camera.fx;
    const int reach = 1 + static_cast<int>(std::ceil(slack_ / pixel_size));
    const int in_u = u - reach * du;
    const int in_v = v - reach * dv;
    const int out_u = u + (reach + 1) * du;
    const int out_v = v + (reach + 1) * dv;
    if (!view_.contains(in_u, in_v) || !view_.contains(out_u, out_v)) return;
    const std::size_t in = image_.index(in_u, in_v);
    const std::size_t out = image_.index(out_u, out_v);
    if (image_.id[in] != image_.id[here]) return;
    if (image_.id[out] != kNothing) return;
    const auto z_in = static_cast<double>(view_.depth[in]);
    const auto z_out = static_cast<double>(view_.depth[out]);
    if (!(z_in > 0.0) && !is_measured(view_, u - 3 * reach * du, v - 3 * reach * dv)) {
      unseen_ += 1.0;
    }
    if (!(z_in > 0.0 && z_out > 0.0)) return;
    const double w_here = 1.0 / double{image_.depth[here]};
    const double w_in = 1.0 / double{image_.depth[in]};
    const double off = std::abs(1.0 / z_in - w_in) / (w_in * w_in);
    if (off > kOwnSurface * (slack_ + noise_ / (w_in * w_in)))
      return;  // not this surface's contour
    const double slope = (w_here - w_in) / reach;
    // How much nearer the measured surface is than its continuation, standard deviations.
    const double nearer =
        (1.0 / z_out - 1.0 / z_in - slope * (2.0 * reach + 1.0)) / (kNoiseOfStep * noise_);
    if (nearer > kOccluder) return;
    Stretch& stretch = stretches_[stretch_index(image_, u, v, direction)];
    stretch.sum += std::max(nearer, -kFarBehind);
    stretch.count += 1.0;
  }

  double share_that_continues() const {
    double continues = kUnseen * unseen_;
    double ends = kContourPrior;
    for (const Stretch& stretch : stretches_) {
      if (stretch.count == 0.0) continue;
      const double step =
          stretch.sum / stretch.count * std::sqrt(std::min(stretch.count, kMostIndependent));
      const double same = std::exp(-0.5 * step * step);
      continues += same * stretch.count;
      ends += (1.0 - same) * stretch.count;
    }
    return continues / (continues + ends);
  }

 private:
  const RenderedDepth& image_;
  const CoarseView& view_;
  double noise_;
  double slack_;
  std::vector<Stretch> stretches_;
  double unseen_ = 0.0;  ///< pixels of the contour
};

}  // namespace

double share_that_continues(const RenderedDepth& image, const CoarseView& view, double noise,
                            double slack) {
  ContourSurvey survey(image, view, noise, slack);
  const ImageWindow& drawn = image.drawn;
  for (int v = drawn.top; v < drawn.bottom(); ++v) {
    for (int u = drawn.left; u < drawn.right(); ++u) {
      if (image.id[image.index(u, v)] == kNothing) continue;
      for (std::size_t direction = 0; direction < kNeighbours.size(); ++direction) {
        survey.look_across(u, v, direction);
      }
    }
  }
  return survey.share_that_continues();
}

}  // namespace lockbox
