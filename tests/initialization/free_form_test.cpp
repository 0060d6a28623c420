// SPDX-License-Identifier: BSD-3-Clause
// Things without flat sides, found and followed.
#include <gtest/gtest.h>

#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/equal_poses.hpp"
#include "lockbox/evaluation/free_form_object.hpp"
#include "lockbox/initialization/initializer.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "seen_model.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

ArticulatedModel loaded_shape(const std::string& block, std::uint64_t number) {
  const TemporaryFolder folder;
  return load_model(write_free_form(draw_free_form(ObjectBlock(block), number), folder.path()),
                    with_cache());
}

/// In the air before a wall, beside a box of its size.
Scene wall_and_box() {
  Scene scene;
  scene.planes.push_back(
      {SceneFrame::world, {0.0, 0.0, 1.3}, -Eigen::Vector3d::UnitZ(), {8.0, 8.0}});
  SceneBox box;
  box.size << 0.12, 0.15, 0.1;
  box.pose.translation() << 0.25, 0.05, 0.9;
  box.pose.linear() =
      Eigen::AngleAxisd(0.6, Eigen::Vector3d(1.0, 1.0, 0.3).normalized()).toRotationMatrix();
  scene.boxes.push_back(box);
  return scene;
}

Configuration held_up(const ArticulatedModel& model) {
  Configuration truth = rest_configuration(model.tree);
  truth.T_camera_base.setIdentity();
  truth.T_camera_base.translation() << -0.05, 0.02, 0.65;
  truth.T_camera_base.linear() =
      (Eigen::AngleAxisd(-2.0, Eigen::Vector3d(1.0, 0.4, 0.3).normalized()) *
       Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
  return truth;
}

void expect_found(const ArticulatedModel& model, const Configuration& found,
                  const Configuration& truth) {
  const Eigen::Isometry3d equal =
      EqualPoses(model).nearest(truth.T_camera_base, found.T_camera_base);
  const Eigen::Isometry3d error = equal.inverse() * found.T_camera_base;
  EXPECT_LT(error.translation().norm(), 0.01);
  EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 4.0 * kRadians);
}

TEST(FreeForm, AnAnimalIsFoundAndFollowed) {
  const ArticulatedModel model = loaded_shape("tune", 1);
  const Scene scene = wall_and_box();
  State state;
  state.configuration = held_up(model);
  const SensorModel sensor = sensor_model("primesense");
  Simulator simulator(model.tree, sensor.camera, {scene, {state}}, sensor, 3, Executor());
  Tracker tracker(model, {});
  for (std::uint64_t frame = 0; frame < 4; ++frame) {
    state.stamp = static_cast<double>(frame) / 30.0;
    if (frame > 0) state.configuration.T_camera_base.pretranslate(Eigen::Vector3d(0.004, 0, 0));
    DepthFrame image;
    simulator.simulate(state, frame, image);
    image.index = frame;
    const TrackingResult& result = tracker.process(image);
    EXPECT_EQ(result.status, TrackingStatus::tracking) << frame;
    EXPECT_EQ(result.searches, 1) << frame;
    expect_found(model, result.configuration, state.configuration);
  }
}

/// Any of its poses about its axis is right, and none makes another doubtful.
TEST(FreeForm, ABottleIsFoundThoughItLooksTheSameFromAllSides) {
  const ArticulatedModel model = loaded_shape("test:1", 0);
  const Configuration truth = held_up(model);
  const TiledCloud cloud = seen(model, truth, wall_and_box());
  const auto found = Initializer(model, {}, Executor()).find(cloud);
  ASSERT_FALSE(found.empty());
  expect_found(model, found.front().configuration, truth);
  EXPECT_GT(found.front().belief, 0.99);
}

TEST(FreeForm, TheAnswerIsTheSameForAnyNumberOfThreads) {
  const ArticulatedModel model = loaded_shape("tune", 2);
  const TiledCloud cloud = seen(model, held_up(model), wall_and_box());
  const auto one = Initializer(model, {}, Executor(1)).find(cloud);
  const auto two = Initializer(model, {}, Executor(2)).find(cloud);
  ASSERT_FALSE(one.empty());
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].configuration.T_camera_base.matrix(),
              two[i].configuration.T_camera_base.matrix());
    EXPECT_EQ(one[i].evidence, two[i].evidence);
  }
}

}  // namespace
}  // namespace lockbox
