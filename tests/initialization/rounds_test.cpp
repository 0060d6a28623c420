// SPDX-License-Identifier: BSD-3-Clause
// A search in parts, which goes on in later images.
#include <gtest/gtest.h>

#include <vector>

#include "lockbox/initialization/initializer.hpp"
#include "registration/mechanism.hpp"
#include "seen_model.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

constexpr int kAll = 100;  // more rounds than there are

class RoundsTest : public ::testing::Test {
 protected:
  /// As through a lens cap.
  static TiledCloud nothing() {
    TiledCloud cloud;
    cloud.assign({640, 480, 575.8, 575.8, 319.5, 239.5}, std::vector<float>(640 * 480, 0.0F), {},
                 Executor(1));
    return cloud;
  }

  const ArticulatedModel& model = bracket();
  const Configuration truth = mechanism_start(model);
  Initializer initializer{model, {}, Executor(1)};
  SearchProgress progress;
};

TEST_F(RoundsTest, GoOnUntilNothingIsLeftToBeTried) {
  std::vector<int> rounds;
  do {
    initializer.find_part(nothing(), std::nullopt, 1, progress);
    rounds.push_back(progress.rounds);
  } while (progress.rounds > 0 && rounds.size() < kAll);
  EXPECT_EQ(rounds, (std::vector{1, 2, 3, 0}));
}

TEST_F(RoundsTest, SeveralAtOnceAreOneAfterTheOther) {
  initializer.find_part(nothing(), std::nullopt, 2, progress);
  EXPECT_EQ(progress.rounds, 2);
  initializer.find_part(nothing(), std::nullopt, kAll, progress);
  EXPECT_EQ(progress.rounds, 0);
}

TEST_F(RoundsTest, EndWhereAnAnswerIsConvincing) {
  const TiledCloud cloud = cloud_of(measured(model, truth, "primesense"));
  const auto found = initializer.find_part(cloud, std::nullopt, 1, progress);
  EXPECT_EQ(progress.rounds, 0);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().configuration.T_camera_base.matrix(),
            initializer.find(cloud).front().configuration.T_camera_base.matrix());
}

/// A box with a knob beneath it, which no view from above shows: turned by half a turn it looks the
/// same, and no closer look at the image tells.
TEST(Rounds, EndWhereOnlyTheTurnIsUnknown) {
  const TemporaryFolder folder;
  const ArticulatedModel box = load_model(folder.write("box.urdf", R"(<robot name="box">
  <link name="box"><visual><geometry><box size="0.3 0.2 0.15"/></geometry></visual>
    <visual><origin xyz="0.1 0.05 -0.085"/><geometry><box size="0.03 0.03 0.03"/></geometry></visual>
  </link></robot>)"),
                                          {});
  Configuration seen = rest_configuration(box.tree);
  seen.T_camera_base = Eigen::Translation3d(0.0, 0.0, 1.0) *
                       Eigen::AngleAxisd(-2.2, Eigen::Vector3d::UnitX()) *
                       Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ());
  Initializer initializer(box, {}, Executor(1));
  SearchProgress progress;
  const auto found =
      initializer.find_part(cloud_of(measured(box, seen, "primesense")), std::nullopt, 1, progress);
  EXPECT_EQ(progress.rounds, 0);
  ASSERT_GE(found.size(), 2U);
  EXPECT_LT(found.front().belief, 0.9);
  EXPECT_TRUE(found[1].is_in_place_of_first);
}

/// Behind a board whose edge has gone so many metres across it.
class HiddenInPart : public RoundsTest {
 protected:
  Candidate found_behind(double hidden) {
    State state;
    state.configuration = truth;
    SceneBox board;
    board.size << 0.5, 0.5, 0.01;
    board.pose.translation() << truth.T_camera_base.translation().x() - 0.37 + hidden,
        truth.T_camera_base.translation().y(), 0.5;
    Scene scene = wall_behind(0.6);
    scene.boxes.push_back(board);
    const SensorModel sensor = sensor_model("primesense");
    DepthFrame frame;
    Simulator(model.tree, sensor.camera, PlacedScene(scene, {state}), sensor, 1, Executor(1))
        .simulate(state, 0, frame);
    return initializer.find_part(cloud_of(frame), std::nullopt, 1, progress).front();
  }
};

TEST_F(HiddenInPart, EndsTheSearchWhereMoreIsShownThanHidden) {
  const Candidate found = found_behind(0.08);
  EXPECT_GT(found.agreement.explained, found.agreement.occluded);
  EXPECT_EQ(progress.rounds, 0);
}

TEST_F(HiddenInPart, GoesOnWhereMoreIsHiddenThoughItsPlaceIsSure) {
  const Candidate found = found_behind(0.15);
  EXPECT_LT(found.agreement.explained, found.agreement.occluded);
  EXPECT_GT(found.belief, 0.999);
  EXPECT_EQ(progress.rounds, 1);
}

/// The object is seen as it was, while a round looks for it that would not find it by itself.
TEST_F(RoundsTest, KeepWhatRoundsBeforeHaveFound) {
  progress.rounds = 2;
  progress.answers = {truth};
  const TiledCloud cloud = cloud_of(measured(model, truth, "primesense"));
  const auto found = initializer.find_part(cloud, std::nullopt, 1, progress);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(
      (found.front().configuration.T_camera_base.translation() - truth.T_camera_base.translation())
          .norm(),
      0.005);
}

}  // namespace
}  // namespace lockbox
