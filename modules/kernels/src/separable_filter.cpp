// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/separable_filter.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "separable_filter.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// next: numbers from a tap to the next one.
HWY_INLINE void filter_row(const std::span<const float> taps, const std::size_t columns,
                           const float* const from, const std::size_t next, float* const to) {
  const hn::CappedTag<float, kFilterBlock> tag;
  for (std::size_t u = 0; u < columns; u += hn::Lanes(tag)) {
    auto sum = hn::Mul(hn::Set(tag, taps[0]), hn::LoadU(tag, from + u));
    for (std::size_t i = 1; i < taps.size(); ++i) {
      const auto both =
          hn::Add(hn::LoadU(tag, from + u - i * next), hn::LoadU(tag, from + u + i * next));
      sum = hn::MulAdd(hn::Set(tag, taps[i]), both, sum);
    }
    hn::StoreU(sum, tag, to + u);
  }
}

void filter_all(const PaddedLayout& layout, const std::span<const float> taps,
                const float* const image, float* const along_rows, float* const filtered) {
  const std::size_t columns = layout.filled_columns();
  for (std::size_t v = 0; v < layout.rows; ++v) {
    const std::size_t row = layout.row(v);
    filter_row(taps, columns, image + row, 1, along_rows + row);
  }
  for (std::size_t v = 0; v < layout.rows; ++v) {
    const std::size_t row = layout.row(v);
    filter_row(taps, columns, along_rows + row, layout.next_row(), filtered + row);
  }
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(filter_all);

void filter_separably(const PaddedLayout& layout, std::span<const float> taps, const float* image,
                      float* along_rows, float* filtered) {
  HWY_DYNAMIC_DISPATCH(filter_all)(layout, taps, image, along_rows, filtered);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
