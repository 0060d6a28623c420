// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/scene_fit.hpp"

#include <gtest/gtest.h>

#include <string>

#include "lockbox/model/articulated_model.hpp"
#include "lockbox/simulation/model_visibility.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "small_models.hpp"

namespace lockbox {
namespace {

const std::string kShare = LOCKBOX_SHARE_DIRECTORY;
const PinholeCamera kRoomCamera{160, 120, 143.95, 143.95, 79.5, 59.5};

Scene room() {
  return read_scene(kShare + "/scenes/room.yaml");
}

State state_of(const KinematicTree& tree, const Eigen::Isometry3d& T_camera_base) {
  State state;
  state.configuration = rest_configuration(tree);
  state.configuration.T_camera_base = T_camera_base;
  return state;
}

KinematicTree block(const Eigen::Vector3d& size) {
  KinematicTree tree;
  tree.bodies = {testing::box_body("block", size, -1)};
  return tree;
}

/// z up in the image, as ROS has it, and the camera on the side of negative y.
Eigen::Isometry3d standing_pose(double distance) {
  Eigen::Isometry3d T_camera_base = Eigen::Isometry3d::Identity();
  T_camera_base.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  T_camera_base.translation().z() = distance;
  return T_camera_base;
}

double hidden(const Scene& scene, const KinematicTree& tree, const State& state) {
  return VisibilityMeter(tree, kRoomCamera, PlacedScene(scene, {state}), Executor(1))
      .measure(state)
      .hidden;
}

void expect_same(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.R_base_scene, b.R_base_scene);
  for (std::size_t i = 0; i < a.planes.size(); ++i) {
    EXPECT_EQ(a.planes[i].point, b.planes[i].point);
  }
  for (std::size_t i = 0; i < a.boxes.size(); ++i) {
    EXPECT_EQ(a.boxes[i].pose.matrix(), b.boxes[i].pose.matrix());
  }
}

TEST(SceneFit, ChangesNothingAroundTheModelsThatTheRoomWasMadeFor) {
  for (const std::string name : {"lockbox", "cabinet", "rigid_block", "board_door_block"}) {
    SCOPED_TRACE(name);
    const KinematicTree tree =
        load_kinematic_tree(kShare + "/models/" + name + "/" + name + ".urdf");
    for (const std::string scene : {"room", "room_with_arm", "room_with_person"}) {
      const Scene written = read_scene(kShare + "/scenes/" + scene + ".yaml");
      expect_same(fitted(written, tree, state_of(tree, facing_pose(1.2))), written);
    }
  }
}

TEST(SceneFit, PutsTheTableUnderAModelThatReachesLower) {
  const KinematicTree tall = block({0.4, 1.4, 0.3});
  const State state = state_of(tall, facing_pose(2.0));
  EXPECT_GT(hidden(room(), tall, state), 0.02);
  const Scene fit = fitted(room(), tall, state);
  EXPECT_EQ(hidden(fit, tall, state), 0.0);
  EXPECT_NEAR(fit.boxes[0].pose.translation().y(), -0.7 - 0.02, 1e-9) << "the table";
  EXPECT_EQ(fit.planes[0].point, room().planes[0].point) << "the wall is far enough";
}

TEST(SceneFit, PutsTheWallBehindAModelThatIsDeep) {
  const KinematicTree deep = block({0.4, 0.4, 1.6});
  const State state = state_of(deep, facing_pose(2.0));
  EXPECT_NEAR(fitted(room(), deep, state).planes[0].point.z(), -0.8 - 0.05, 1e-9);
}

TEST(SceneFit, StandsUprightAroundAModelWhoseZAxisIsUp) {
  const KinematicTree tall = block({0.3, 0.3, 1.2});
  const State state = state_of(tall, standing_pose(2.0));
  EXPECT_GT(hidden(room(), tall, state), 0.9) << "behind the floor";
  const Scene fit = fitted(room(), tall, state);
  EXPECT_EQ(hidden(fit, tall, state), 0.0);
  EXPECT_EQ(fit.R_base_scene.col(1), Eigen::Vector3d::UnitZ()) << "up";
  EXPECT_EQ(fit.R_base_scene.col(2), Eigen::Vector3d(-Eigen::Vector3d::UnitY())) << "to the camera";
  EXPECT_NEAR(fit.boxes[0].pose.translation().y(), -0.6 - 0.02, 1e-9);
}

/// As cameras have it, and models whose frame is the camera's.
TEST(SceneFit, StandsUprightAroundAModelWhoseYAxisIsDown) {
  const KinematicTree carton = block({0.3, 0.2, 0.25});
  const State state = state_of(carton, Eigen::Isometry3d(Eigen::Translation3d(0.03, 0.02, 0.9)));
  const Scene fit = fitted(room(), carton, state);
  EXPECT_EQ(hidden(fit, carton, state), 0.0);
  EXPECT_EQ(fit.R_base_scene.col(1), Eigen::Vector3d(-Eigen::Vector3d::UnitY())) << "up";
  EXPECT_EQ(fit.R_base_scene.col(2), Eigen::Vector3d(-Eigen::Vector3d::UnitZ()));
}

TEST(SceneFit, ShowsEveryShippedModelWhereItBegins) {
  for (const std::string name :
       {"lockbox", "cabinet", "rigid_block", "board_door_block", "carton", "carton_pair"}) {
    SCOPED_TRACE(name);
    LoadOptions options;
    options.cache_directory = LOCKBOX_CACHE;
    const ArticulatedModel model =
        load_model(kShare + "/models/" + name + "/" + name + ".urdf", options);
    State state;
    state.configuration = model.parameters.initial_configuration.value();
    EXPECT_LT(hidden(fitted(room(), model.tree, state), model.tree, state), 0.01);
  }
}

TEST(SceneFit, LeavesScenesAloneThatAreNotAboutAModel) {
  const KinematicTree tall = block({0.3, 0.3, 1.2});
  Scene scene = room();
  scene.room.reset();
  expect_same(fitted(scene, tall, state_of(tall, standing_pose(2.0))), scene);
}

}  // namespace
}  // namespace lockbox
