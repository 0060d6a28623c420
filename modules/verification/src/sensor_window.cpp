// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_window.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "evidence_constants.hpp"

namespace lockbox {
namespace {

/// Cells of a window, to each side of its middle.
constexpr int kHalf = 2;
static_assert(kHalf * kHalf * 4 == static_cast<int>(evidence::kWindow));

using Window = std::array<float, 2 * kHalf + 1>;

float nearest(const Window& cells) {
  return *std::max_element(cells.begin(), cells.end());
}

float farthest(const Window& cells) {
  return *std::min_element(cells.begin(), cells.end());
}

/// Of what is not blank; blank where the middle is.
float mean(const Window& cells) {
  float sum = 0.0F;
  float count = 0.0F;
  for (const float cell : cells) {
    sum += cell;
    count += cell > 0.0F ? 1.0F : 0.0F;
  }
  return cells[kHalf] > 0.0F ? sum / count : 0.0F;
}

/// Along rows and columns; at the border as if the image went on as it ends.
template <float (*of)(const Window&)>
void pass(int width, const Executor& executor, std::vector<float>& cells,
          std::vector<float>& passed) {
  const int height = static_cast<int>(cells.size()) / width;
  passed.resize(cells.size());
  for (const bool is_along_row : {true, false}) {
    executor.for_each(static_cast<std::size_t>(height), [&](std::size_t row) {
      const int v = static_cast<int>(row);
      for (int u = 0; u < width; ++u) {
        Window window;
        for (int i = -kHalf; i <= kHalf; ++i) {
          const int at_u = is_along_row ? std::clamp(u + i, 0, width - 1) : u;
          const int at_v = is_along_row ? v : std::clamp(v + i, 0, height - 1);
          window[static_cast<std::size_t>(i + kHalf)] =
              cells[static_cast<std::size_t>(at_v) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(at_u)];
        }
        passed[row * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)] = of(window);
      }
    });
    cells.swap(passed);
  }
}

}  // namespace

std::span<const float> SensorWindow::smear(std::span<const float> cells, int width,
                                           const Executor& executor) {
  cells_.assign(cells.begin(), cells.end());
  pass<nearest>(width, executor, cells_, passed_);
  pass<farthest>(width, executor, cells_, passed_);
  pass<mean>(width, executor, cells_, passed_);
  return cells_;
}

}  // namespace lockbox
