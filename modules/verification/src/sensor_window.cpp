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

/// Pointers to the cells of a window, as it slides along a row.
using Window = std::array<const float*, 2 * kHalf + 1>;

struct Nearest {
  static float of(const Window& cells, int u) {
    float most = cells[0][u];
    for (const float* const row : cells) most = std::max(most, row[u]);
    return most;
  }
};

struct Farthest {
  static float of(const Window& cells, int u) {
    float least = cells[0][u];
    for (const float* const row : cells) least = std::min(least, row[u]);
    return least;
  }
};

/// Of what is not blank; blank where the middle is.
struct Mean {
  static float of(const Window& cells, int u) {
    float sum = 0.0F;
    float count = 0.0F;
    for (const float* const row : cells) {
      sum += row[u];
      count += row[u] > 0.0F ? 1.0F : 0.0F;
    }
    return cells[kHalf][u] > 0.0F ? sum / count : 0.0F;
  }
};

/// Along rows and columns; at the border as if the image went on as it ends.
template <typename Sum>
void pass(int width, const Executor& executor, std::vector<float>& cells,
          std::vector<float>& passed) {
  const int height = static_cast<int>(cells.size()) / width;
  passed.resize(cells.size());
  const auto row_of = [&](std::vector<float>& of, int v) {
    return of.data() + static_cast<std::ptrdiff_t>(std::clamp(v, 0, height - 1)) * width;
  };
  const auto slide = [&](const Window& window, float* out) {
    for (int u = 0; u < width; ++u) out[u] = Sum::of(window, u);
  };
  const auto rows = static_cast<std::size_t>(height);
  executor.for_each(rows, [&](std::size_t row) {
    const int v = static_cast<int>(row);
    std::vector<float> wider(static_cast<std::size_t>(width + 2 * kHalf));
    const float* const here = row_of(cells, v);
    for (int i = 0; i < width + 2 * kHalf; ++i) {
      wider[static_cast<std::size_t>(i)] = here[std::clamp(i - kHalf, 0, width - 1)];
    }
    Window window;
    for (std::size_t i = 0; i < window.size(); ++i) window[i] = wider.data() + i;
    slide(window, row_of(passed, v));
  });
  executor.for_each(rows, [&](std::size_t row) {
    const int v = static_cast<int>(row);
    Window window;
    for (int i = -kHalf; i <= kHalf; ++i) {
      window[static_cast<std::size_t>(i + kHalf)] = row_of(passed, v + i);
    }
    slide(window, row_of(cells, v));
  });
}

}  // namespace

std::span<const float> SensorWindow::smear(std::span<const float> cells, int width,
                                           const Executor& executor) {
  cells_.assign(cells.begin(), cells.end());
  pass<Nearest>(width, executor, cells_, passed_);
  pass<Farthest>(width, executor, cells_, passed_);
  pass<Mean>(width, executor, cells_, passed_);
  return cells_;
}

}  // namespace lockbox
