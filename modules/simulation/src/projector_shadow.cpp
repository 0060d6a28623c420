// SPDX-License-Identifier: BSD-3-Clause
#include "projector_shadow.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "rows_at_once.hpp"

namespace lockbox::simulation {
namespace {

constexpr float kJump = 1.0F;  ///< samples of disparity: more is another surface

/// The largest disparity at each column of one row of the projector's image.
class LitRow {
 public:
  /// Columns below the camera's first one are kept as far as disparities reach.
  void clear(int width, float largest_disparity) {
    first_ = -static_cast<int>(std::ceil(largest_disparity)) - 1;
    disparity_.assign(static_cast<std::size_t>(width - first_), 0.0F);
  }

  /// A surface from one sample to the next, or a single sample: then both are the same.
  void light(float begin, float end, float disparity) {
    for (int column = rounded(std::min(begin, end)); column <= rounded(std::max(begin, end));
         ++column) {
      float& lit = disparity_[index(column)];
      lit = std::max(lit, disparity);
    }
  }

  float at(float column) const { return disparity_[index(rounded(column))]; }

 private:
  static int rounded(float column) { return static_cast<int>(std::floor(column + 0.5F)); }
  std::size_t index(int column) const { return static_cast<std::size_t>(column - first_); }

  int first_ = 0;
  std::vector<float> disparity_;
};

/// unit_disparity_depth: where the disparity is one sample, metres. Infinite depths have none.
void cover_row(const float* depth, int width, float unit_disparity_depth, LitRow& row,
               std::uint8_t* covered) {
  const auto disparity = [&](int u) { return unit_disparity_depth / depth[u]; };
  const auto column = [&](int u) { return static_cast<float>(u) - disparity(u); };
  row.clear(width, unit_disparity_depth / *std::min_element(depth, depth + width));
  for (int u = 0; u < width; ++u) {
    const bool goes_on = u + 1 < width && std::abs(disparity(u + 1) - disparity(u)) <= kJump;
    row.light(column(u), goes_on ? column(u + 1) : column(u), disparity(u));
  }
  for (int u = 0; u < width; ++u) {
    covered[u] = row.at(column(u)) > disparity(u) + kJump ? 1 : 0;
  }
}

}  // namespace

void ProjectorShadow::cast(const RenderedDepth& image, const PinholeCamera& camera, double baseline,
                           const Executor& executor) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto unit_disparity_depth = static_cast<float>(camera.fx * baseline);
  covered_.resize(image.depth.size());
  executor.for_each_chunk(static_cast<std::size_t>(image.height), kRowsAtOnce,
                          [&](std::size_t begin, std::size_t end, std::size_t) {
                            LitRow row;
                            for (std::size_t v = begin; v < end; ++v) {
                              cover_row(&image.depth[v * width], image.width, unit_disparity_depth,
                                        row, &covered_[v * width]);
                            }
                          });
}

}  // namespace lockbox::simulation
