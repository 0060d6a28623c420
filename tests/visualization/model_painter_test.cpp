// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/model_painter.hpp"

#include <gmock/gmock.h>

#include "block_model.hpp"

namespace lockbox {
namespace {

using testing::AllOf;
using testing::Each;
using testing::Gt;
using testing::Lt;

constexpr PinholeCamera kCamera{80, 60, 100.0, 100.0, 39.5, 29.5};

std::vector<int> color_at(const RgbImage& image, int u, int v) {
  const auto first = image.rgb.begin() + 3 * (v * image.width + u);
  return {first, first + 3};
}

TEST(ModelPainter, DrawsTheBodyInItsColorAndLeavesTheRest) {
  const auto tree = block_tree({0.2, 0.2, 0.1}, {1.0F, 0.0F, 0.0F, 1.0F});
  RgbImage image(kCamera.width, kCamera.height, 255);
  ModelPainter(tree, kCamera, Executor(1)).paint(one_metre_away(), 1.0F, image);

  const auto centre = color_at(image, 40, 30);
  EXPECT_GT(centre[0], 100);
  EXPECT_EQ(centre[1], 0);
  EXPECT_EQ(centre[2], 0);
  EXPECT_EQ(color_at(image, 2, 2), (std::vector<int>{255, 255, 255}));
}

// Half-size 0.1 m, 0.95 m away, 100 px focal length: 10.526 px to each side of 39.5 and 29.5.
TEST(ModelPainter, PutsTheEdgeWhereTheCameraSeesIt) {
  const auto tree = block_tree({0.2, 0.2, 0.1}, {0.0F, 0.0F, 0.0F, 1.0F});
  RgbImage image(kCamera.width, kCamera.height, 200);
  ModelPainter(tree, kCamera, Executor(1)).paint(one_metre_away(), 1.0F, image);

  double covered = 0.0;  // pixels of row 30
  for (int u = 0; u < kCamera.width; ++u) covered += 1.0 - color_at(image, u, 30)[0] / 200.0;
  EXPECT_NEAR(covered, 2 * 10.526, 0.51);  // two samples a pixel
  EXPECT_EQ(color_at(image, 29, 30), color_at(image, 50, 30)) << "symmetric about the axis";
}

TEST(ModelPainter, LetsTheBackgroundThroughBelowFullOpacity) {
  const auto tree = block_tree({0.2, 0.2, 0.1}, {0.0F, 0.0F, 0.0F, 1.0F});
  RgbImage image(kCamera.width, kCamera.height, 200);
  ModelPainter(tree, kCamera, Executor(1)).paint(one_metre_away(), 0.5F, image);
  EXPECT_THAT(color_at(image, 40, 30), Each(AllOf(Gt(98), Lt(102))));
}

TEST(ModelPainter, ShadesFacesByTheirDirection) {
  const auto tree = block_tree({0.2, 0.2, 0.2}, {1.0F, 1.0F, 1.0F, 1.0F});
  auto configuration = one_metre_away();
  configuration.T_camera_base.rotate(Eigen::AngleAxisd(0.785, Eigen::Vector3d::UnitY()));
  RgbImage image(kCamera.width, kCamera.height, 0);
  ModelPainter(tree, kCamera, Executor(1)).paint(configuration, 1.0F, image);
  // The edge between the two visible faces is in the middle; the light comes from the left.
  EXPECT_GT(color_at(image, 34, 30)[0], color_at(image, 45, 30)[0] + 20);
}

TEST(ModelPainter, DrawsWhatHasNoColorInOrangeWhereItIsAskedTo) {
  const auto color_of = [](const Eigen::Vector4f& rgba, GreyModel grey) {
    const auto tree = block_tree({0.2, 0.2, 0.1}, rgba);
    RgbImage image(kCamera.width, kCamera.height, 100);
    ModelPainter(tree, kCamera, Executor(1), grey).paint(one_metre_away(), 0.65F, image);
    return color_at(image, 40, 30);
  };
  const Eigen::Vector4f grey(0.7F, 0.7F, 0.7F, 1.0F);
  const auto kept = color_of(grey, GreyModel::as_it_is);
  EXPECT_EQ(kept[0], kept[2]);
  const auto orange = color_of(grey, GreyModel::in_orange);
  EXPECT_GT(orange[0], orange[2] + 60);
  const auto blue = color_of({0.2F, 0.2F, 0.9F, 1.0F}, GreyModel::in_orange);
  EXPECT_GT(blue[2], blue[0]) << "it has a colour";
}

}  // namespace
}  // namespace lockbox
