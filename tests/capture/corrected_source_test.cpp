// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/corrected_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lockbox {
namespace {

using testing::ElementsAre;

/// Two frames of 3 x 1 pixels, the middle one on the optical axis.
class ThreePixels : public FrameSource {
 public:
  explicit ThreePixels(std::vector<std::uint16_t> depth) : depth_(std::move(depth)) {}

  bool next(DepthFrame& frame) override {
    if (delivered_ == 2) return false;
    frame.camera = {3, 1, 10.0, 10.0, 1.0, 0.0};
    frame.depth = depth_;
    frame.metres_per_unit = 0.001F;
    frame.index = delivered_++;
    return true;
  }
  std::optional<std::size_t> frame_count() const override { return 2; }
  std::string description() const override { return "three pixels"; }

 private:
  std::vector<std::uint16_t> depth_;
  std::uint64_t delivered_ = 0;
};

std::vector<std::uint16_t> corrected(const std::vector<std::uint16_t>& depth,
                                     const DepthCorrection& correction) {
  CorrectedSource source(std::make_unique<ThreePixels>(depth), correction);
  DepthFrame first;
  DepthFrame second;
  EXPECT_TRUE(source.next(first) && source.next(second));
  EXPECT_EQ(first.depth, second.depth);
  EXPECT_EQ(second.index, 1U);
  EXPECT_FALSE(source.next(second));
  return first.depth;
}

TEST(CorrectedSource, ScalesShiftsAndBendsDepths) {
  EXPECT_THAT(corrected({1000, 2000, 0}, {.scale = 1.01}), ElementsAre(1010, 2020, 0));
  EXPECT_THAT(corrected({1000, 2000, 0}, {.offset = -0.02}), ElementsAre(980, 1980, 0));
  EXPECT_THAT(corrected({1000, 2000, 0}, {.quadratic = 0.003}), ElementsAre(1003, 2012, 0));
  EXPECT_THAT(corrected({1000, 2000, 3}, {}), ElementsAre(1000, 2000, 3));
}

TEST(CorrectedSource, CorrectsMoreTowardsTheCorners) {
  // A tenth of the focal length off the axis, r^2 = 0.01.
  EXPECT_THAT(corrected({1000, 1000, 2000}, {.radial = 0.5}), ElementsAre(1005, 1000, 2010));
}

TEST(CorrectedSource, WhatLeavesSixteenBitsIsNoMeasurement) {
  EXPECT_THAT(corrected({65000, 10, 20}, {.scale = 1.1, .offset = -0.015}), ElementsAre(0, 0, 7));
}

TEST(CorrectedSource, SaysThatItCorrects) {
  const CorrectedSource source(std::make_unique<ThreePixels>(std::vector<std::uint16_t>(3)), {});
  EXPECT_EQ(source.description(), "three pixels, depths corrected");
  EXPECT_EQ(source.frame_count(), 2U);
}

}  // namespace
}  // namespace lockbox
