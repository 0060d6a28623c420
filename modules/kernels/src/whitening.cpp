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
using One = hn::CappedTag<float, 1>;

/// Rows that are eliminated together.
constexpr std::size_t kPanel = 4;

/// Cholesky's factors, row by row, and with the same steps the solution: a panel of rows less what
/// all earlier ones take of them, then the rows of the panel by each other. Vectors begin at
/// multiples of their length: what they change below the diagonal is not read again.
class Whitener {
 public:
  Whitener(PaddedRows& covariance, PaddedRows& values)
      : factors_(covariance.row(0).data()),
        values_(values.row(0).data()),
        factor_stride_(covariance.stride()),
        value_stride_(values.stride()),
        rows_(covariance.rows()),
        columns_(values.columns()) {}

  void whiten() {
    std::size_t first = 0;
    for (; first + kPanel <= rows_; first += kPanel) eliminate<kPanel>(first);
    for (; first < rows_; ++first) eliminate<1>(first);
  }

 private:
  template <std::size_t Rows>
  HWY_INLINE void eliminate(const std::size_t first) {
    const std::size_t lanes = hn::Lanes(Tag());
    const std::size_t begin = first / lanes * lanes;
    subtract_earlier<Rows>(first, factors_, factor_stride_, begin, rows_);
    subtract_earlier<Rows>(first, values_, value_stride_, 0, columns_);
    const Panel<Rows> panel(factors_ + first * factor_stride_ + first, factor_stride_);
    panel.solve(factors_ + first * factor_stride_, factor_stride_, begin, rows_);
    panel.solve(values_ + first * value_stride_, value_stride_, 0, columns_);
  }

  /// Of rows from `first` on.
  template <std::size_t Rows>
  HWY_INLINE void subtract_earlier(const std::size_t first, float* const matrix,
                                   const std::size_t stride, const std::size_t begin,
                                   const std::size_t end) {
    const Tag tag;
    for (std::size_t j = begin; j < end; j += hn::Lanes(tag)) {
      hn::Vec<Tag> rest[Rows];
      for (std::size_t t = 0; t < Rows; ++t) {
        rest[t] = hn::Load(tag, matrix + (first + t) * stride + j);
      }
      for (std::size_t k = 0; k < first; ++k) {
        const float* const by = factors_ + k * factor_stride_ + first;
        const auto row = hn::Load(tag, matrix + k * stride + j);
        for (std::size_t t = 0; t < Rows; ++t) {
          rest[t] = hn::NegMulAdd(hn::Set(tag, by[t]), row, rest[t]);
        }
      }
      for (std::size_t t = 0; t < Rows; ++t) {
        hn::Store(rest[t], tag, matrix + (first + t) * stride + j);
      }
    }
  }

  /// The triangle on the diagonal that a panel's rows share, factored.
  template <std::size_t Rows>
  class Panel {
   public:
    HWY_INLINE Panel(const float* const diagonal, const std::size_t stride) {
      const One one;
      for (std::size_t k = 0; k < Rows; ++k) {
        for (std::size_t j = k; j < Rows; ++j) {
          auto rest = hn::Set(one, diagonal[k * stride + j]);
          for (std::size_t t = 0; t < k; ++t) {
            rest = hn::NegMulAdd(hn::Set(one, factor_[t][k]), hn::Set(one, factor_[t][j]), rest);
          }
          factor_[k][j] = hn::GetLane(rest);
        }
        inverse_[k] = 1.0F / std::sqrt(factor_[k][k]);
        for (std::size_t j = k; j < Rows; ++j) factor_[k][j] *= inverse_[k];
      }
    }

    HWY_INLINE void solve(float* const rows, const std::size_t stride, const std::size_t begin,
                          const std::size_t end) const {
      const Tag tag;
      for (std::size_t j = begin; j < end; j += hn::Lanes(tag)) {
        hn::Vec<Tag> solved[Rows];
        for (std::size_t k = 0; k < Rows; ++k) {
          auto rest = hn::Load(tag, rows + k * stride + j);
          for (std::size_t t = 0; t < k; ++t) {
            rest = hn::NegMulAdd(hn::Set(tag, factor_[t][k]), solved[t], rest);
          }
          solved[k] = hn::Mul(rest, hn::Set(tag, inverse_[k]));
          hn::Store(solved[k], tag, rows + k * stride + j);
        }
      }
    }

   private:
    float factor_[Rows][Rows] = {};
    float inverse_[Rows] = {};
  };

  float* factors_;  ///< of the covariance, in its place
  float* values_;
  std::size_t factor_stride_;
  std::size_t value_stride_;
  std::size_t rows_;
  std::size_t columns_;
};

void whiten_rows(PaddedRows& covariance, PaddedRows& values) {
  if (covariance.rows() > 0) Whitener(covariance, values).whiten();
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
