// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/edge_moments.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

namespace lockbox::kernels {
namespace {

constexpr float kReference = 0.7F;
constexpr std::size_t kRowStride = kWindowSide + 5;
constexpr std::size_t kSeen = kWindowSide - 1;  // that pixels look at, with neighbours

class EdgeMoments : public ::testing::Test {
 protected:
  EdgeMoments() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> depth(0.4F, 1.0F);
    std::uniform_int_distribution<int> body(-1, 2);
    for (float& d : d_) d = depth(random);
    for (std::int16_t& b : body_) b = static_cast<std::int16_t>(body(random));
    for (float& tap : taps_.at_samples) tap = depth(random);
    for (float& tap : taps_.between_samples) tap = depth(random);
  }

  static std::size_t at(std::size_t row, std::size_t column) { return row * kRowStride + column; }

  /// The step to the next sample if the body moves it, and the inverse depth of the nearer.
  std::pair<float, float> step(std::size_t here, std::size_t next, std::int16_t body) const {
    const float rise = d_[next] - d_[here];
    const float mover = rise > 0.0F ? body_[next] : body_[here];
    return {mover == body ? rise * kSamplesPerPixel : 0.0F, std::max(d_[next], d_[here])};
  }

  void expect_column(const ColumnMoments& moments, std::size_t pixel_row, std::size_t column,
                     std::int16_t body) const {
    ColumnMoments expected{};
    for (std::size_t t = 0; t < kWindowTaps; ++t) {
      const std::size_t here = at(kSamplesPerPixel * pixel_row + t, column);
      const float d = body_[here] == body ? d_[here] : 0.0F;
      expected.d[0] += taps_.at_samples[t] * d;
      expected.d_squared[0] += taps_.at_samples[t] * d * d;
      const auto [along_u, nearer_u] = step(here, here + 1, body);
      expected.step_u[0] += taps_.at_samples[t] * along_u;
      expected.step_u_d[0] += taps_.at_samples[t] * along_u * nearer_u;
      const auto [along_v, nearer_v] = step(here, here + kRowStride, body);
      expected.step_v[0] += taps_.between_samples[t] * along_v;
      expected.step_v_d[0] += taps_.between_samples[t] * along_v * nearer_v;
    }
    EXPECT_NEAR(moments.d[column], expected.d[0], 1e-4);
    EXPECT_NEAR(moments.d_squared[column], expected.d_squared[0], 1e-4);
    EXPECT_NEAR(moments.step_u[column], expected.step_u[0], 1e-4);
    EXPECT_NEAR(moments.step_u_d[column], expected.step_u_d[0], 1e-4);
    EXPECT_NEAR(moments.step_v[column], expected.step_v[0], 1e-4);
    EXPECT_NEAR(moments.step_v_d[column], expected.step_v_d[0], 1e-4);
  }

  std::array<float, kWindowSide * kRowStride> d_;
  std::array<std::int16_t, kWindowSide * kRowStride> body_;
  EdgeWindow window_{d_.data(), body_.data(), kRowStride};
  WindowTaps taps_;
};

TEST_F(EdgeMoments, SumColumnsOfABodyWithEveryInstructionSet) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    for (const std::int16_t body : std::array<std::int16_t, 2>{0, 2}) {
      for (std::size_t row = 0; row < kWindowPixels; ++row) {
        ColumnMoments moments;
        blur_columns(window_, taps_, row, {0, kWindowPixels}, body, moments);
        for (std::size_t column = 0; column + 1 < kSeen; ++column) {
          expect_column(moments, row, column, body);
        }
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST_F(EdgeMoments, SumWhatPixelsOfARowLookAtWithEveryInstructionSet) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    for (std::size_t first = 0; first < kWindowPixels; ++first) {
      for (std::size_t end = first + 1; end <= kWindowPixels; ++end) {
        ColumnMoments moments;
        blur_columns(window_, taps_, 3, {first, end}, 2, moments);
        const std::size_t end_column = kSamplesPerPixel * (end - 1) + kWindowTaps;
        for (std::size_t column = kSamplesPerPixel * first; column < end_column; ++column) {
          if (column + 1 < kSeen) expect_column(moments, 3, column, 2);
        }
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST_F(EdgeMoments, SumSquaresWithEveryInstructionSet) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    for (std::size_t first = 0; first < kWindowPixels; ++first) {
      alignas(64) ColumnMoments::Sums squares;
      blur_squares(window_, taps_, 5, {first, kWindowPixels}, kReference, squares);
      for (std::size_t column = kSamplesPerPixel * first; column + 1 < kSeen; ++column) {
        float expected = 0.0F;
        for (std::size_t t = 0; t < kWindowTaps; ++t) {
          const float offset = d_[at(5 * kSamplesPerPixel + t, column)] - kReference;
          expected += taps_.at_samples[t] * offset * offset;
        }
        EXPECT_NEAR(squares[column], expected, 1e-5);
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST_F(EdgeMoments, FindPixelsThatBendWithEveryInstructionSet) {
  constexpr std::size_t kCentre = kWindowTaps / 2;
  constexpr float kLeast = 0.5F;
  for (std::size_t i = 0; i < d_.size(); i += 13) d_[i] = 0.0F;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    std::size_t found = 0;
    for (std::size_t row = 0; row < kWindowPixels; ++row) {
      const std::uint32_t bits = find_bending(window_, row, kLeast);
      for (std::size_t column = 0; column < kWindowPixels; ++column) {
        const std::size_t here =
            at(kCentre + kSamplesPerPixel * row, kCentre + kSamplesPerPixel * column);
        const float left = d_[here - kSamplesPerPixel];
        const float right = d_[here + kSamplesPerPixel];
        const float above = d_[here - kSamplesPerPixel * kRowStride];
        const float below = d_[here + kSamplesPerPixel * kRowStride];
        const bool shows_all = std::min({d_[here], left, right, above, below}) > 0.0F;
        const bool bends = std::abs(left + right - 2.0F * d_[here]) > kLeast ||
                           std::abs(above + below - 2.0F * d_[here]) > kLeast;
        EXPECT_EQ((bits >> column & 1U) != 0, shows_all && bends) << row << ' ' << column;
        found += shows_all && bends ? 1 : 0;
      }
      EXPECT_EQ(bits >> kWindowPixels, 0U);
    }
    EXPECT_GT(found, 5U);
    EXPECT_LT(found, 60U);
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace lockbox::kernels
