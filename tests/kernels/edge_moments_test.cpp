// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/edge_moments.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <random>

namespace lockbox::kernels {
namespace {

constexpr float kReference = 0.7F;

class EdgeMoments : public ::testing::Test {
 protected:
  EdgeMoments() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> depth(0.4F, 1.0F);
    std::uniform_int_distribution<int> body(-1, 2);
    for (float& d : window_.d) d = depth(random);
    for (float& b : window_.body) b = static_cast<float>(body(random));
    for (float& tap : taps_.at_samples) tap = depth(random);
    for (float& tap : taps_.between_samples) tap = depth(random);
  }

  static std::size_t at(std::size_t row, std::size_t column) {
    return row * kWindowStride + column;
  }

  /// The step to the next sample if the body moves it, and the inverse depth of the nearer.
  std::pair<float, float> step(std::size_t here, std::size_t next, float body) const {
    const float rise = window_.d[next] - window_.d[here];
    const float mover = rise > 0.0F ? window_.body[next] : window_.body[here];
    return {mover == body ? rise * kSamplesPerPixel : 0.0F,
            std::max(window_.d[next], window_.d[here])};
  }

  void expect_column(const ColumnMoments& moments, std::size_t pixel_row, std::size_t column,
                     float body) const {
    ColumnMoments expected{};
    for (std::size_t t = 0; t < kWindowTaps; ++t) {
      const std::size_t here = at(kSamplesPerPixel * pixel_row + t, column);
      const float d = window_.body[here] == body ? window_.d[here] : 0.0F;
      expected.d[0] += taps_.at_samples[t] * d;
      expected.d_squared[0] += taps_.at_samples[t] * d * d;
      const auto [along_u, nearer_u] = step(here, here + 1, body);
      expected.step_u[0] += taps_.at_samples[t] * along_u;
      expected.step_u_d[0] += taps_.at_samples[t] * along_u * nearer_u;
      const auto [along_v, nearer_v] = step(here, here + kWindowStride, body);
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

  EdgeWindow window_;
  WindowTaps taps_;
};

TEST_F(EdgeMoments, SumColumnsOfABodyWithEveryInstructionSet) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    for (const float body : {0.0F, 2.0F}) {
      for (std::size_t row = 0; row < kWindowPixels; ++row) {
        ColumnMoments moments;
        blur_columns(window_, taps_, row, {0, kWindowPixels}, body, moments);
        for (std::size_t column = 0; column + 1 < kWindowRows; ++column) {
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
        blur_columns(window_, taps_, 3, {first, end}, 2.0F, moments);
        const std::size_t end_column = kSamplesPerPixel * (end - 1) + kWindowTaps;
        for (std::size_t column = kSamplesPerPixel * first; column < end_column; ++column) {
          if (column + 1 < kWindowRows) expect_column(moments, 3, column, 2.0F);
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
      for (std::size_t column = kSamplesPerPixel * first; column + 1 < kWindowRows; ++column) {
        float expected = 0.0F;
        for (std::size_t t = 0; t < kWindowTaps; ++t) {
          const float offset = window_.d[at(5 * kSamplesPerPixel + t, column)] - kReference;
          expected += taps_.at_samples[t] * offset * offset;
        }
        EXPECT_NEAR(squares[column], expected, 1e-5);
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace lockbox::kernels
