// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/separable_filter.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdlib>
#include <random>
#include <vector>

namespace lockbox::kernels {
namespace {

const std::vector<float> kTaps{1.0F, 0.8F, 0.4F, 0.1F};
const PaddedLayout kLayout{37, 11, kTaps.size() - 1};

float tap(std::size_t a, std::size_t b) {
  const auto distance = static_cast<std::size_t>(
      std::abs(static_cast<std::ptrdiff_t>(a) - static_cast<std::ptrdiff_t>(b)));
  return distance < kTaps.size() ? kTaps[distance] : 0.0F;
}

TEST(SeparableFilter, SumsAllPixelsByTheirDistanceWithEveryInstructionSet) {
  std::mt19937 random(1);
  std::normal_distribution<float> number;
  std::vector<float> image(kLayout.size(), 0.0F);
  for (std::size_t v = 0; v < kLayout.rows; ++v) {
    for (std::size_t u = 0; u < kLayout.columns; ++u) image[kLayout.row(v) + u] = number(random);
  }
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    std::vector<float> along_rows(kLayout.size(), 0.0F);
    std::vector<float> filtered(kLayout.size(), 0.0F);
    filter_separably(kLayout, kTaps, image.data(), along_rows.data(), filtered.data());
    for (std::size_t v = 0; v < kLayout.rows; ++v) {
      for (std::size_t u = 0; u < kLayout.columns; ++u) {
        float expected = 0.0F;
        for (std::size_t y = 0; y < kLayout.rows; ++y) {
          for (std::size_t x = 0; x < kLayout.columns; ++x) {
            expected += tap(u, x) * tap(v, y) * image[kLayout.row(y) + x];
          }
        }
        ASSERT_NEAR(filtered[kLayout.row(v) + u], expected, 1e-4) << u << ", " << v;
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace lockbox::kernels
