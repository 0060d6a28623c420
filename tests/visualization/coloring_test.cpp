// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/coloring.hpp"

#include <gmock/gmock.h>

#include <set>

#include "block_model.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/visualization/scene_composer.hpp"
#include "lockbox/visualization/surface_sigma.hpp"

namespace lockbox {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kWidth = 60;

/// A row across the block, whose front face is at 0.95 m and 21 pixels wide.
DepthFrame row_of(std::uint16_t depth) {
  DepthFrame frame;
  frame.camera = {kWidth, 3, 100.0, 100.0, 29.5, 1.0};
  frame.depth.assign(std::size_t{3} * kWidth, depth);
  return frame;
}

class ColoringTest : public testing::Test {
 protected:
  const DisplayedScene& colored(const DepthFrame& frame, Coloring coloring,
                                const ShownEstimate& estimate) {
    SceneChoices choices;
    choices.coloring = coloring;
    return composer_.compose(&frame, estimate, "", choices);
  }

  static std::vector<int> color_of(const DisplayedScene& scene, std::ptrdiff_t point) {
    return {scene.point_rgb.begin() + 3 * point, scene.point_rgb.begin() + 3 * point + 3};
  }

  static std::vector<int> bytes(const Eigen::Vector3f& color) {
    const Eigen::Vector3i whole = (255.0F * color).cast<int>();
    return {whole.x(), whole.y(), whole.z()};
  }

  static std::vector<int> legend_color(const DisplayedScene& scene, const std::string& name) {
    for (const auto& entry : scene.legend) {
      if (entry.name.starts_with(name)) return bytes(entry.color);
    }
    ADD_FAILURE() << "no " << name;
    return {};
  }

  const ArticulatedModel model_ = block_model();
  SceneComposer composer_{model_, ""};
};

constexpr std::ptrdiff_t kMiddle = kWidth + kWidth / 2;
constexpr std::ptrdiff_t kBeside = kWidth + 2;

TEST(ColoringNames, AreThoseOfTheEnumeration) {
  EXPECT_EQ(coloring_named("plain"), Coloring::plain);
  EXPECT_EQ(coloring_named("uncertainty"), Coloring::uncertainty);
  EXPECT_THROW(coloring_named("rainbow"), InputError);
  EXPECT_EQ(coloring_of_key("t"), Coloring::terms);
  EXPECT_EQ(coloring_of_key("p"), std::nullopt);
}

TEST_F(ColoringTest, OfBodiesNamesThemAndLeavesTheRestGrey) {
  const DisplayedScene& scene = colored(row_of(952), Coloring::bodies, {one_metre_away()});
  ASSERT_THAT(scene.legend, SizeIs(1));
  EXPECT_EQ(color_of(scene, kMiddle), legend_color(scene, model_.tree.bodies[0].name));
  EXPECT_NE(color_of(scene, kBeside), color_of(scene, kMiddle));
  ASSERT_THAT(scene.part_rgb, SizeIs(1));
  EXPECT_THAT(scene.part_rgb[0], SizeIs(3 * model_.tree.bodies[0].visuals[0].mesh.vertices.size()));
}

TEST_F(ColoringTest, OfTermsTellsTheSurfaceFromItsEdgesWhatIsSeenThroughAndWhatIsHidden) {
  const DisplayedScene on_it = colored(row_of(952), Coloring::terms, {one_metre_away()});
  EXPECT_EQ(color_of(on_it, kMiddle), legend_color(on_it, "points"));
  const auto grey = color_of(on_it, kBeside);
  std::set<std::vector<int>> colors;
  for (std::ptrdiff_t u = 0; u < kWidth; ++u) colors.insert(color_of(on_it, kWidth + u));
  EXPECT_THAT(colors, testing::UnorderedElementsAre(grey, legend_color(on_it, "points"),
                                                    legend_color(on_it, "edges")));
  const DisplayedScene behind = colored(row_of(2000), Coloring::terms, {one_metre_away()});
  EXPECT_EQ(color_of(behind, kMiddle), legend_color(behind, "free space"));
  EXPECT_EQ(color_of(behind, kBeside), grey);
  const DisplayedScene before = colored(row_of(500), Coloring::terms, {one_metre_away()});
  EXPECT_EQ(color_of(before, kMiddle), legend_color(before, "hidden"));
}

TEST_F(ColoringTest, OfUncertaintyIsOfTheModelAndHidesNoneOfIt) {
  ShownEstimate estimate(one_metre_away());
  estimate.covariance = 1e-6 * Eigen::MatrixXd::Identity(6, 6);
  const DisplayedScene& scene = colored(row_of(952), Coloring::uncertainty, estimate);
  EXPECT_THAT(scene.part_rgb, SizeIs(1));
  EXPECT_TRUE(scene.is_scale_logarithmic);
  EXPECT_NEAR(scene.scale.front().value, 0.01, 1e-9);
  EXPECT_NEAR(scene.scale.back().value, 10.0, 1e-9);
  EXPECT_LT(scene.points.size(), std::size_t{3} * kWidth - 30) << "points on the model";
  EXPECT_GT(scene.points.size(), std::size_t{kWidth}) << "points beside it";
}

TEST_F(ColoringTest, OfUncertaintySaysWhereNothingIsTold) {
  const DisplayedScene& scene = colored(row_of(952), Coloring::uncertainty, {one_metre_away()});
  EXPECT_THAT(scene.part_rgb, IsEmpty());
  ASSERT_THAT(scene.legend, SizeIs(1));
  EXPECT_THAT(scene.legend[0].name, HasSubstr("no deviations"));
}

TEST(SurfaceSigma, GrowsWithTheDistanceFromTheAxisOfAnUncertainTurn) {
  const KinematicTree tree = block_model().tree;
  ShownEstimate estimate(one_metre_away());
  estimate.covariance = Eigen::MatrixXd::Zero(6, 6);
  estimate.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 0.0, 0.0, 1e-4;
  const SurfaceSigma sigma(tree, {estimate.configuration.T_camera_base}, estimate);
  EXPECT_NEAR(sigma.at(0, Eigen::Vector3d::Zero()), std::sqrt(3e-6), 1e-8);
  EXPECT_NEAR(sigma.at(0, {0.0, 0.0, 0.3}), std::sqrt(3e-6), 1e-8) << "on the axis";
  EXPECT_NEAR(sigma.at(0, {0.4, 0.0, 0.0}), std::sqrt(3e-6 + 16e-6), 1e-8);
}

/// A drawer on the block, which slides along x.
KinematicTree with_drawer() {
  KinematicTree tree = block_model().tree;
  tree.bodies.push_back(tree.bodies[0]);
  tree.bodies[1].parent_joint = 0;
  Joint joint;
  joint.name = "drawer";
  joint.type = JointType::prismatic;
  joint.axis = Eigen::Vector3d::UnitX();
  joint.parent_body = 0;
  joint.child_body = 1;
  joint.variable = 0;
  tree.joints = {joint};
  tree.variable_joint = {0};
  tree.file_order = {0};
  return tree;
}

TEST(SurfaceSigma, IsThatOfTheJointsWhereOnlyTheseAreTold) {
  const KinematicTree tree = with_drawer();
  ShownEstimate estimate(one_metre_away(), {0.002});
  estimate.configuration.q = Eigen::VectorXd::Zero(1);
  const std::vector<Eigen::Isometry3d> poses(2, estimate.configuration.T_camera_base);
  const SurfaceSigma sigma(tree, poses, estimate);
  EXPECT_EQ(sigma.at(0, Eigen::Vector3d::Zero()), 0.0F);
  EXPECT_NEAR(sigma.at(1, Eigen::Vector3d::Zero()), 0.002, 1e-8);

  estimate.sigma = {std::numeric_limits<double>::infinity()};
  const SurfaceSigma unseen(tree, poses, estimate);
  EXPECT_EQ(unseen.at(1, Eigen::Vector3d::Zero()), kUndetermined);
  EXPECT_EQ(unseen.at(0, Eigen::Vector3d::Zero()), 0.0F);
}

}  // namespace
}  // namespace lockbox
