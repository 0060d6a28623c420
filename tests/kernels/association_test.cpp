// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox::kernels {
namespace {

/// Association of one point at hand-made distances from bodies, with unit variance.
struct Association {
  explicit Association(const std::vector<float>& distances, float visible_body = -1.0F)
      : visible(kLanes, visible_body), averaged_pixels(kLanes, 1.0F) {
    for (const float d : distances) {
      body.push_back(static_cast<float>(body.size()));
      distance.emplace_back(kLanes, kPadding).front() = d;
      inverse_variance.emplace_back(kLanes, 1.0F);
      weight.emplace_back(kLanes, -1.0F);
    }
  }
  double run() {
    std::vector<const float*> d, iv;
    std::vector<float*> w;
    for (std::size_t l = 0; l < distance.size(); ++l) {
      d.push_back(distance[l].data());
      iv.push_back(inverse_variance[l].data());
      w.push_back(weight[l].data());
    }
    const Candidates candidates{kLanes, d,     iv,   body, visible.data(), averaged_pixels.data(),
                                reach,  kGate, kOdds};
    const double cost = associate(candidates, w);
    EXPECT_NEAR(cost, association_cost(candidates), 1e-4);
    return cost;
  }

  static constexpr float kGate = 4.0F;
  static constexpr float kOdds = 20.0F;
  float reach = 0.0F;
  std::vector<float> body, visible, averaged_pixels;
  std::vector<std::vector<float>> distance, inverse_variance, weight;
};

constexpr double kOutlierCost = 0.5 * Association::kGate * Association::kGate;

TEST(AssociationTest, LoneBodyIsQuadraticWithinTheCutAndConstantBeyond) {
  for (const float d : {0.0F, 0.5F, 2.0F, 3.9F, 4.1F, 100.0F}) {
    Association one({d});
    const double gaussian = std::exp(-0.5 * static_cast<double>(d * d));
    const double expected = -std::log(std::exp(-kOutlierCost) + gaussian) - kOutlierCost;
    EXPECT_NEAR(one.run(), expected, 1e-4);
    EXPECT_NEAR(one.weight[0][0], gaussian / (gaussian + std::exp(-kOutlierCost)), 1e-5);
  }
  EXPECT_NEAR(Association({50.0F}).run(), 0.0, 1e-6);
}

TEST(AssociationTest, NothingExplainsAPointFartherBesideTheBodiesThanTheyReach) {
  Association beside({0.5F, 1.0F}, label_beside(0.02F));
  beside.reach = 0.019F;
  EXPECT_NEAR(beside.run(), 0.0, 1e-6);
  EXPECT_EQ(beside.weight[0][0], 0.0F);
  beside.reach = 0.021F;
  EXPECT_EQ(beside.run(), Association({0.5F, 1.0F}, label_beside(0.0F)).run());
  EXPECT_LT(beside.run(), -1.0);
}

TEST(AssociationTest, ABodyFarBeyondTheCutChangesNothing) {
  Association alone({1.0F});
  Association with_far({1.0F, 50.0F});
  EXPECT_NEAR(alone.run(), with_far.run(), 1e-5);
  EXPECT_NEAR(alone.weight[0][0], with_far.weight[0][0], 1e-5);
  EXPECT_LT(with_far.weight[1][0], 1e-20F);
}

TEST(AssociationTest, AMeanOfPixelsCountsAsManyTimes) {
  Association pixel({0.7F, 1.5F}, 1.0F);
  Association mean({0.7F, 1.5F}, 1.0F);
  mean.averaged_pixels.front() = 25.0F;
  EXPECT_NEAR(mean.run(), 25.0 * pixel.run(), 1e-4);
  for (std::size_t l = 0; l < 2; ++l) {
    EXPECT_NEAR(mean.weight[l][0], 25.0F * pixel.weight[l][0], 1e-4F);
  }
}

TEST(AssociationTest, TiesHaveNoWinner) {
  Association tie({0.7F, 0.7F, 0.7F});
  tie.run();
  EXPECT_EQ(tie.weight[0][0], tie.weight[1][0]);
  EXPECT_EQ(tie.weight[1][0], tie.weight[2][0]);
}

TEST(AssociationTest, VisibilityDecidesBetweenBodiesThatAreAsNear) {
  Association near({0.7F, 0.7F}, 1.0F);
  near.run();
  EXPECT_NEAR(near.weight[1][0] / near.weight[0][0], Association::kOdds, 1e-3);
  Association moved({0.7F, 20.0F},
                    1.0F);  // the visible body has left: the other explains the point
  moved.run();
  EXPECT_GT(moved.weight[0][0], 0.99F);
}

TEST(AssociationTest, WeightsAreTheDerivativeOfTheCost) {
  const std::vector<float> start{0.4F, -1.3F, 2.6F};
  constexpr float kStep = 0.05F;  // costs are in single precision
  Association at(start, 2.0F);
  at.run();
  for (std::size_t l = 0; l < 3; ++l) {
    const auto difference = [&](float by) {
      auto nearer = start;
      auto farther = start;
      nearer[l] -= by;
      farther[l] += by;
      return Association(farther, 2.0F).run() - Association(nearer, 2.0F).run();
    };
    // Of the fourth order.
    const double numeric =
        (8.0 * difference(kStep) - difference(2.0F * kStep)) / (12.0 * static_cast<double>(kStep));
    EXPECT_NEAR(numeric, static_cast<double>(at.weight[l][0] * start[l]), 1e-4 * std::abs(numeric));
  }
}

}  // namespace
}  // namespace lockbox::kernels
