// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/verification/contour_agreement.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "lockbox/view/contour.hpp"

namespace lockbox {
namespace {

constexpr int kBeyond = 3;  // pixels of the view, across a contour
/// A board on a wall stands out by less than a pixel's noise allows. But a whole side of a contour
/// across which the scene steps back in the mean, by so many standard deviations, ends there. A
/// plate that is imagined aslant in a wall has it behind on one side, too, but within as beyond.
constexpr double kStepsBack = 1.25;

/// What is measured in a pixel of the view, behind what is expected there, in standard deviations;
/// nothing if nothing is.
std::optional<double> behind(const VisibleSurface& surface, const Pixel& pixel, double expected,
                             const TiledCloud& cloud, const ViewOptions& options) {
  const Pixel seen = surface.camera_pixel(pixel.u, pixel.v);
  const std::size_t i =
      static_cast<std::size_t>(seen.v) * static_cast<std::size_t>(cloud.camera().width) +
      static_cast<std::size_t>(seen.u);
  const auto measured = static_cast<double>(cloud.depth()[i]);
  if (measured <= 0.0) return std::nullopt;
  return (measured - expected) / options.noise.sigma_z(expected);
}

/// Most samples lie so: the model is to be seen to all sides of them.
bool shows_model_around(const RenderedDepth& view, const Pixel& sample) {
  if (sample.u < kBeyond || sample.v < kBeyond || sample.u >= view.width - kBeyond ||
      sample.v >= view.height - kBeyond) {
    return false;
  }
  const auto beyond = static_cast<std::ptrdiff_t>(kBeyond);
  const std::int16_t* const id = &view.id[view.index(sample.u, sample.v)];
  const std::ptrdiff_t down = beyond * view.width;
  return ((id[-beyond] != kNothing) & (id[beyond] != kNothing) & (id[-down] != kNothing) &
          (id[down] != kNothing)) != 0;
}

}  // namespace

void look_beyond(const VisibleSurface& surface, const Pixel& sample, const TiledCloud& cloud,
                 const ViewOptions& options, ContourSides& sides) {
  const RenderedDepth& view = surface.view();
  if (shows_model_around(view, sample)) return;
  // (du, dv) to the four sides.
  constexpr std::array<std::array<int, 2>, 4> kWays{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  for (std::size_t way = 0; way < kWays.size(); ++way) {
    const auto& [du, dv] = kWays[way];
    const int u = sample.u + kBeyond * du;
    const int v = sample.v + kBeyond * dv;
    if (u < 0 || v < 0 || u >= view.width || v >= view.height ||
        view.id[view.index(u, v)] != kNothing) {
      continue;
    }
    const TangentPlane plane(view, sample.u, sample.v);
    const double here = static_cast<double>(view.depth[view.index(sample.u, sample.v)]);
    const double there = here * plane.relative_depth(kBeyond * du, kBeyond * dv);
    const auto beyond = behind(surface, {u, v}, there, cloud, options);
    if (beyond && *beyond < -options.gate) {
      continue;
    }
    ++sides[way].pixel_by_pixel.samples;
    if (!beyond) continue;
    sides[way].pixel_by_pixel.goes_on += *beyond < options.gate ? 1 : 0;
    const auto within = behind(surface, sample, here, cloud, options);
    if (!within || *within < -options.gate) continue;
    ++sides[way].measured;
    sides[way].step += std::min(*beyond, options.gate) - std::min(*within, options.gate);
  }
}

void add(const ContourSides& sides, ContourSides& sums) {
  for (std::size_t way = 0; way < sides.size(); ++way) {
    sums[way].pixel_by_pixel.samples += sides[way].pixel_by_pixel.samples;
    sums[way].pixel_by_pixel.goes_on += sides[way].pixel_by_pixel.goes_on;
    sums[way].measured += sides[way].measured;
    sums[way].step += sides[way].step;
  }
}

/// Adds the sides of one body. Neighbouring pixels err alike, so that less than a side says little
/// more than one.
void add(const ContourSides& sides, ContourAgreement& contour) {
  for (const auto& [pixel_by_pixel, measured, step] : sides) {
    contour.samples += pixel_by_pixel.samples;
    const bool ends = step > kStepsBack * measured;
    contour.goes_on += ends ? 0 : pixel_by_pixel.goes_on;
  }
}

}  // namespace lockbox
