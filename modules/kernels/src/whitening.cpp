// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/whitening.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "whitening.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kLanes>;

HWY_INLINE void scale(float* const row, const std::size_t begin, const std::size_t end,
                      const float factor) {
  const Tag tag;
  const auto by = hn::Set(tag, factor);
  for (std::size_t j = begin; j < end; j += hn::Lanes(tag)) {
    hn::Store(hn::Mul(hn::Load(tag, row + j), by), tag, row + j);
  }
}

/// Rows of both matrices that are done, and used together.
constexpr std::size_t kPanel = 4;

/// row <- row - factors . rows of a panel, the first Rows of them.
template <std::size_t Rows>
HWY_INLINE void subtract(float* const row, const std::size_t begin, const std::size_t end,
                         const float* const* const factors, const float* const* const panel,
                         const std::size_t column) {
  const Tag tag;
  hn::Vec<Tag> by[Rows];
  for (std::size_t t = 0; t < Rows; ++t) by[t] = hn::Set(tag, factors[t][column]);
  for (std::size_t j = begin; j < end; j += hn::Lanes(tag)) {
    auto rest = hn::Load(tag, row + j);
    for (std::size_t t = 0; t < Rows; ++t) {
      rest = hn::NegMulAdd(by[t], hn::Load(tag, panel[t] + j), rest);
    }
    hn::Store(rest, tag, row + j);
  }
}

/// Cholesky's factors, row by row, and with the same steps the solution. Vectors begin at multiples
/// of their length: what they change below the diagonal is not read again.
class Whitener {
 public:
  Whitener(PaddedRows& covariance, PaddedRows& values)
      : covariance_(covariance),
        values_(values),
        rows_(covariance.rows()),
        columns_(values.columns()) {}

  void whiten() {
    for (std::size_t first = 0; first < rows_; first += kPanel) {
      const std::size_t end = std::min(first + kPanel, rows_);
      for (std::size_t k = first; k < end; ++k) {
        factors_[k - first] = covariance_.row(k).data();
        solved_[k - first] = values_.row(k).data();
        for (std::size_t t = first; t < k; ++t) subtract_rows<1>(t - first, k);
        const float inverse = 1.0F / std::sqrt(factors_[k - first][k]);
        scale(covariance_.row(k).data(), first_column(k), rows_, inverse);
        scale(values_.row(k).data(), 0, columns_, inverse);
      }
      for (std::size_t i = end; i < rows_; ++i) subtract_rows<kPanel>(0, i);
    }
  }

 private:
  static std::size_t first_column(std::size_t row) {
    const std::size_t lanes = hn::Lanes(Tag());
    return row / lanes * lanes;
  }

  /// Rows of the panel from row t of it on.
  template <std::size_t Rows>
  HWY_INLINE void subtract_rows(const std::size_t t, const std::size_t i) {
    subtract<Rows>(values_.row(i).data(), 0, columns_, factors_ + t, solved_ + t, i);
    subtract<Rows>(covariance_.row(i).data(), first_column(i), rows_, factors_ + t, factors_ + t,
                   i);
  }

  PaddedRows& covariance_;
  PaddedRows& values_;
  std::size_t rows_;
  std::size_t columns_;
  const float* factors_[kPanel] = {};  ///< the rows of the panel
  const float* solved_[kPanel] = {};
};

void whiten_rows(PaddedRows& covariance, PaddedRows& values) {
  Whitener(covariance, values).whiten();
}

/// Some rows of the products at once, so that no sum waits for itself.
template <std::size_t Sums>
HWY_INLINE void multiply_some(const std::size_t rows, PaddedRows& values, const std::size_t first,
                              PaddedRows& products) {
  const Tag tag;
  for (std::size_t j = 0; j < values.columns(); j += hn::Lanes(tag)) {
    hn::Vec<Tag> sums[Sums];
    for (auto& sum : sums) sum = hn::Zero(tag);
    for (std::size_t k = 0; k < rows; ++k) {
      const float* const row = values.row(k).data();
      const auto others = hn::Load(tag, row + j);
      for (std::size_t s = 0; s < Sums; ++s) {
        sums[s] = hn::MulAdd(hn::Set(tag, row[first + s]), others, sums[s]);
      }
    }
    for (std::size_t s = 0; s < Sums; ++s) {
      hn::Store(sums[s], tag, products.row(first + s).data() + j);
    }
  }
}

void multiply_all_columns(const std::size_t rows, PaddedRows& values, PaddedRows& products) {
  constexpr std::size_t kTogether = 4;
  std::size_t column = 0;
  for (; column + kTogether <= values.columns(); column += kTogether) {
    multiply_some<kTogether>(rows, values, column, products);
  }
  for (; column < values.columns(); ++column) multiply_some<1>(rows, values, column, products);
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(whiten_rows);
HWY_EXPORT(multiply_all_columns);

void whiten(PaddedRows& covariance, PaddedRows& values) {
  HWY_DYNAMIC_DISPATCH(whiten_rows)(covariance, values);
}

void multiply_columns(std::size_t rows, PaddedRows& values, PaddedRows& products) {
  products.resize(values.columns(), values.columns());
  HWY_DYNAMIC_DISPATCH(multiply_all_columns)(rows, values, products);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
