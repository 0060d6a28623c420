// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/drawn_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lockbox/simulation/model_visibility.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/terms/collision_term.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

const PinholeCamera kDrawnCamera{640, 480, 575.8, 575.8, 319.5, 239.5};

ArticulatedModel loaded(const ObjectDraft& draft) {
  const TemporaryFolder folder;
  const auto file = folder.write(draft.name + ".urdf", urdf_text(draft));
  LoadOptions options;
  options.cache_directory = LOCKBOX_CACHE;
  return load_model(file, options);
}

double penetration(const ArticulatedModel& model, const Configuration& configuration) {
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(model.tree, configuration, poses);
  return CollisionTerm(model, CollisionOptions{}).cost(model, poses);
}

void expect_sound(DrawnKind kind, const ArticulatedModel& model, const DrawnView& view) {
  const Configuration& truth = view.truth.configuration;
  for (int v = 0; v < model.tree.variables(); ++v) {
    const VariableLimits limits = variable_limits(model.tree, v);
    EXPECT_GE(truth.q[v], limits.lower);
    EXPECT_LE(truth.q[v], limits.upper);
  }
  EXPECT_EQ(penetration(model, truth), 0.0);
  const CollisionTerm collision(model, CollisionOptions{});
  constexpr double kFieldError = 0.0003;  // metres: of bodies that touch
  for (const CollisionPair& pair : collision.pairs()) EXPECT_LT(pair.rest_overlap, kFieldError);
  const PlacedScene scene(view.scene, {view.truth});
  const ModelVisibility seen =
      VisibilityMeter(model.tree, kDrawnCamera, scene, Executor(1)).measure(view.truth);
  EXPECT_LE(seen.cut, 0.15);
  const auto out = kind == DrawnKind::furniture ? Eigen::Vector3d(0.0, -1.0, 0.0)
                                                : Eigen::Vector3d(0.0, 0.0, 1.0);
  EXPECT_LT((truth.T_camera_base.linear() * out).z(), 0.0) << "the front faces the camera";
}

TEST(DrawnView, OfFurnitureKeepsToItsRanges) {
  const ObjectBlock block("tune");
  const ArticulatedModel model = loaded(draw_furniture(block, 1));
  expect_sound(DrawnKind::furniture, model,
               draw_view(DrawnKind::furniture, model, kDrawnCamera, block, 1));
}

TEST(DrawnView, OfABoardKeepsToItsRanges) {
  const ObjectBlock block("test:1");
  const ArticulatedModel model = loaded(draw_board(block, 2));
  expect_sound(DrawnKind::board, model, draw_view(DrawnKind::board, model, kDrawnCamera, block, 2));
}

TEST(DrawnView, OfAHouseholdStandsAmongOtherThings) {
  const ObjectBlock block("test:0");
  const ArticulatedModel model = loaded(draw_household(block, 2));
  const DrawnView view = draw_view(DrawnKind::household, model, kDrawnCamera, block, 2);
  EXPECT_EQ(penetration(model, view.truth.configuration), 0.0);
  EXPECT_GE(view.scene.boxes.size(), 2U);
  EXPECT_TRUE(view.placement == "table" || view.placement == "air") << view.placement;
  const PlacedScene scene(view.scene, {view.truth});
  const ModelVisibility seen =
      VisibilityMeter(model.tree, kDrawnCamera, scene, Executor(1)).measure(view.truth);
  EXPECT_LE(seen.cut, 0.02);
  EXPECT_LE(seen.hidden, 0.4);
}

TEST(DrawnView, FollowsFromBlockAndNumber) {
  const ObjectBlock block("tune");
  const ArticulatedModel model = loaded(draw_furniture(block, 1));
  const auto pose = [&](std::uint64_t number) {
    return draw_view(DrawnKind::furniture, model, kDrawnCamera, block, number)
        .truth.configuration.T_camera_base.matrix();
  };
  EXPECT_EQ(pose(1), pose(1));
  EXPECT_NE(pose(1), pose(2));
}

/// Depths of the view without noise; 0 where nothing is.
std::vector<float> depths(const KinematicTree& tree, const DrawnView& view) {
  const SensorModel sensor = sensor_model("ideal");
  DepthFrame image;
  Simulator(tree, kDrawnCamera, PlacedScene(view.scene, {view.truth}), sensor, 1, Executor(1))
      .simulate(view.truth, 0, image);
  std::vector<float> metres;
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) metres.push_back(image.metres(u, v));
  }
  return metres;
}

/// Of kinds that slide, turn, lie on tables and hang on walls.
TEST(DrawnView, OfALargerObjectIsTheSameToThePixel) {
  constexpr double kSize = 1.7;
  const ObjectBlock block("tune");
  for (const DrawnKind kind : {DrawnKind::furniture, DrawnKind::board, DrawnKind::household}) {
    const std::uint64_t number = 3;
    const ObjectDraft draft = kind == DrawnKind::furniture ? draw_furniture(block, number)
                              : kind == DrawnKind::board   ? draw_board(block, number)
                                                           : draw_household(block, number);
    const ArticulatedModel model = loaded(draft);
    const DrawnView view = draw_view(kind, model, kDrawnCamera, block, number);
    const TemporaryFolder folder;
    const KinematicTree larger =
        load_kinematic_tree(folder.write("larger.urdf", urdf_text(scaled(draft, kSize))));
    const std::vector<float> near = depths(model.tree, view);
    const std::vector<float> far = depths(larger, scaled(view, larger, kSize));
    std::size_t alike = 0;
    std::size_t seen = 0;
    for (std::size_t i = 0; i < near.size(); ++i) {
      if (!(near[i] > 0.0F && far[i] > 0.0F)) continue;
      ++seen;
      alike += std::abs(far[i] - kSize * near[i]) < 0.004F ? 1U : 0U;
    }
    EXPECT_GT(static_cast<double>(alike), 0.999 * static_cast<double>(seen));
    EXPECT_GT(seen, near.size() / 4);
  }
}

TEST(DrawnSensor, OfTestsIsNotThatOfTuning) {
  const auto sensors = [](const char* block) {
    std::set<std::string> names;
    for (std::uint64_t number = 0; number < 50; ++number) {
      names.insert(draw_sensor(ObjectBlock(block), number));
    }
    return names;
  };
  EXPECT_EQ(sensors("tune"), (std::set<std::string>{"primesense", "primesense-quiet"}));
  EXPECT_EQ(sensors("test:1"), (std::set<std::string>{"primesense", "structured-light", "white"}));
}

}  // namespace
}  // namespace lockbox
