// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/global_experiment.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "lockbox/core/error.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "lockbox/model/symmetry.hpp"
#include "rigid_model.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

const PinholeCamera kCamera{640, 480, 575.8, 575.8, 319.5, 239.5};

TEST(RandomScene, KeepsToItsRanges) {
  const ArticulatedModel model = rigid(make_box({0.4, 0.3, 0.1}));
  const RandomSceneOptions options;
  for (std::uint64_t number = 0; number < 10; ++number) {
    const RandomScene drawn = draw_random_scene(model, kCamera, 5, number, options);
    const Eigen::Isometry3d& T = drawn.truth.configuration.T_camera_base;
    const Eigen::Vector3d front = T * Eigen::Vector3d(0.0, 0.0, 0.05);
    const double tilt = std::acos(-T.linear().col(2).dot(front.normalized()));
    EXPECT_GE(front.norm(), options.min_distance - 1e-9);
    EXPECT_LE(front.norm(), options.max_distance + 1e-9);
    EXPECT_LE(tilt, options.max_tilt + 1e-9);
    EXPECT_GE(drawn.visible, options.least_visible);
  }
}

TEST(RandomScene, FollowsFromSeedAndNumber) {
  const ArticulatedModel model = rigid(make_box({0.4, 0.3, 0.1}));
  const auto pose = [&](std::uint64_t seed, std::uint64_t number) {
    return draw_random_scene(model, kCamera, seed, number)
        .truth.configuration.T_camera_base.matrix();
  };
  EXPECT_EQ(pose(1, 2), pose(1, 2));
  EXPECT_NE(pose(1, 2), pose(1, 3));
  EXPECT_NE(pose(1, 2), pose(2, 2));
}

TEST(Symmetries, OfABoxAreItsHalfTurns) {
  EXPECT_EQ(find_symmetries(rigid(make_box({0.3, 0.2, 0.1}))).size(), 4U);
}

TEST(Symmetries, OfASquarePlateIncludeItsQuarterTurns) {
  EXPECT_EQ(find_symmetries(rigid(make_box({0.2, 0.2, 0.05}))).size(), 8U);
  EXPECT_EQ(find_symmetries(rigid(make_box({0.2, 0.2, 0.2}))).size(), 24U);
}

TEST(Symmetries, VanishWithASmallKnob) {
  TriangleMesh mesh = make_box({0.3, 0.2, 0.1});
  append(mesh, transformed(make_box({0.04, 0.04, 0.04}),
                           Eigen::Isometry3d(Eigen::Translation3d(0.1, 0.05, 0.06))));
  EXPECT_EQ(find_symmetries(rigid(mesh)).size(), 1U);
}

TEST(MirrorImage, OfABoxIsABoxAndThatOfABoxWithAKnobOnItsCornerIsNot) {
  const auto is_own_mirror_image_with_knob = [](double x, double y) {
    TriangleMesh mesh = make_box({0.3, 0.2, 0.1});
    append(mesh, transformed(make_box({0.04, 0.04, 0.04}),
                             Eigen::Isometry3d(Eigen::Translation3d(x, y, 0.06))));
    const ArticulatedModel model = rigid(mesh);
    return is_own_mirror_image(model, rest_configuration(model.tree));
  };
  EXPECT_TRUE(is_own_mirror_image_with_knob(0.0, 0.0));
  EXPECT_TRUE(is_own_mirror_image_with_knob(0.1, 0.0));
  EXPECT_FALSE(is_own_mirror_image_with_knob(0.1, 0.05));
}

TEST(GlobalResults, ComeBackAsTheyWereWritten) {
  const TemporaryFolder folder;
  const auto file = folder / "global_results.csv";
  GlobalResult result;
  result.scene = 12;
  result.placement = Placement::on_wall;
  result.wrong = "base";
  result.status = TrackingStatus::uncertain;
  result.within = true;
  result.seconds = 0.75;
  write_global_results(file, {result, result});
  const auto read = read_global_results(file);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1].scene, 12U);
  EXPECT_EQ(read[1].placement, Placement::on_wall);
  EXPECT_EQ(read[1].wrong, "base");
  EXPECT_EQ(read[1].status, TrackingStatus::uncertain);
  EXPECT_TRUE(read[1].within);
  EXPECT_EQ(read[1].seconds, 0.75);
}

TEST(GlobalResults, LeaveOutARowThatWasCutOff) {
  const TemporaryFolder folder;
  const auto file = folder / "global_cut_off.csv";
  write_global_results(file, {GlobalResult{}});
  std::ofstream(file, std::ios::app) << "13,free,0,0.5";
  EXPECT_EQ(read_global_results(file).size(), 1U);
}

TEST(GlobalResults, NameTheLineThatIsWrong) {
  const TemporaryFolder folder;
  const auto file = folder / "global_wrong.csv";
  write_global_results(file, {GlobalResult{}});
  std::ofstream(file, std::ios::app) << "13,nowhere\n";
  EXPECT_THROW(read_global_results(file), InputError);
}

}  // namespace
}  // namespace lockbox
