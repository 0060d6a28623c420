// SPDX-License-Identifier: BSD-3-Clause
// What tells of small things close to a camera, and what a sensor cannot show of them.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "initialization/seen_model.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/sensor/sensor_model.hpp"
#include "lockbox/sensor/sensor_noise.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/verification/belief.hpp"
#include "lockbox/verification/verifier.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

struct Box {
  Eigen::Vector3d size;
  Eigen::Vector3d middle;
};

KinematicTree made_of(const std::vector<Box>& boxes) {
  const TemporaryFolder folder;
  std::ofstream urdf(folder / "thing.urdf");
  urdf << "<robot name=\"thing\"><link name=\"thing\">";
  for (const auto& [size, middle] : boxes) {
    urdf << "<visual><origin xyz=\"" << middle.transpose() << "\"/><geometry><box size=\""
         << size.transpose() << "\"/></geometry></visual>";
  }
  urdf << "</link></robot>";
  urdf.close();
  return load_kinematic_tree(folder / "thing.urdf");
}

/// Faces the camera half a metre away, turned about its normal.
Configuration facing(const KinematicTree& tree, double turn) {
  Configuration configuration = rest_configuration(tree);
  configuration.T_camera_base =
      Eigen::Translation3d(0.0, 0.0, 0.5) *
      Eigen::AngleAxisd(M_PI + 0.3, Eigen::Vector3d(1.0, 0.5, 0.0).normalized()) *
      Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
  return configuration;
}

/// Looks at a thing before a wall, turned about its normal.
Verifier looking_at(const KinematicTree& thing, const KinematicTree& with, double turn = 0.0) {
  State state;
  state.configuration = facing(thing, turn);
  DepthFrame frame;
  const SensorModel sensor = sensor_model("primesense");
  Simulator(thing, sensor.camera, {wall_behind(0.3), {state}}, sensor, 3, Executor())
      .simulate(state, 0, frame);
  TiledCloud cloud;
  cloud.assign(frame, {}, Executor());
  Verifier verifier(with);
  verifier.look_at(cloud, SensorNoise{}, Executor());
  return verifier;
}

/// A plate of 15 x 10 cm, half of which stands out.
TEST(SmallThings, ATwentiethOfTheirSizeTellsHowTheyAreTurned) {
  const KinematicTree step =
      made_of({{{0.15, 0.10, 0.03}, {0, 0, 0}}, {{0.075, 0.10, 0.007}, {0.0375, 0, 0.0185}}});
  Verifier verifier = looking_at(step, step);
  const double right = verifier.evidence(facing(step, 0.0)).total();
  EXPECT_GT(right, least_evidence());
  EXPECT_LT(verifier.evidence(facing(step, M_PI)).total(), right - 10.0) << right;
}

/// Slats of 15 mm and what is between them.
KinematicTree slats(double gap) {
  std::vector<Box> boxes;
  for (double x = -0.1; x < 0.1; x += 0.015 + gap) {
    boxes.push_back({{0.015, 0.15, 0.02}, {x + 0.0075, 0, 0}});
  }
  return made_of(boxes);
}

/// Of 7 pixels.
TEST(SmallThings, GapsThatASensorMayFillSpeakAgainstNothing) {
  const KinematicTree filled = made_of({{{0.2, 0.15, 0.02}, {0, 0, 0}}});
  const KinematicTree narrow = slats(0.006);
  const Evidence evidence = looking_at(filled, narrow).evidence(facing(narrow, 0.0));
  EXPECT_GT(evidence.contradicted, -5.0);
  EXPECT_GT(evidence.total(), 10.0);
}

/// Of 40 pixels.
TEST(SmallThings, GapsThatItCannotFillDo) {
  const KinematicTree filled = made_of({{{0.2, 0.15, 0.02}, {0, 0, 0}}});
  const KinematicTree wide = slats(0.035);
  const Evidence evidence = looking_at(filled, wide).evidence(facing(wide, 0.0));
  EXPECT_LT(evidence.contradicted, -15.0);
}

/// A bar of two or three cells: single cells of the image end on both sides, and do not say towards
/// which.
TEST(SmallThings, BarsOfFewCellsDoNotSpeakAgainstThemselves) {
  constexpr double kTurn = 1.0;
  for (const double width : {0.006, 0.008}) {
    const KinematicTree lamp = made_of({{{0.08, 0.08, 0.03}, {0.0, -0.1, 0.0}},
                                        {{width, 0.2, 0.03}, {0.0, 0.0, 0.0}},
                                        {{0.06, 0.06, 0.04}, {0.0, 0.12, 0.0}}});
    const Evidence evidence = looking_at(lamp, lamp, kTurn).evidence(facing(lamp, kTurn));
    EXPECT_GT(evidence.contradicted, -5.0) << width;
  }
}

/// A box, and a bar beside it that slides to the right, of which a fifth stands out from behind a
/// screen.
TEST(SmallThings, ABodyOfWhichThreeQuartersAreHiddenTellsNothing) {
  const TemporaryFolder folder;
  const KinematicTree thing = load_kinematic_tree(folder.write("thing.urdf", R"(
    <robot name="thing">
      <link name="box"><visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>
      <link name="bar"><visual><geometry><box size="0.1 0.04 0.04"/></geometry></visual></link>
      <joint name="slide" type="prismatic"><parent link="box"/><child link="bar"/>
        <origin xyz="0.14 0 0"/><axis xyz="1 0 0"/>
        <limit lower="0" upper="0.2" effort="1" velocity="1"/></joint>
    </robot>)"));
  State state;
  state.configuration = rest_configuration(thing);
  state.configuration.T_camera_base =
      Eigen::Translation3d(-0.1, 0.0, 0.6) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX());
  Scene scene = wall_behind(-0.4);  // its z axis points away from the camera
  SceneBox screen;
  screen.size << 0.5, 0.3, 0.01;
  screen.pose.translation() << 0.258, 0.0, 0.5;
  scene.boxes.push_back(screen);
  DepthFrame frame;
  const SensorModel sensor = sensor_model("primesense");
  Simulator(thing, sensor.camera, {scene, {state}}, sensor, 3, Executor())
      .simulate(state, 0, frame);
  TiledCloud cloud;
  cloud.assign(frame, {}, Executor());
  Verifier verifier(thing);
  verifier.look_at(cloud, SensorNoise{}, Executor());
  const Evidence shown = verifier.evidence(state.configuration);
  Configuration hidden = state.configuration;
  hidden.q[0] = 0.15;
  const Evidence without = verifier.evidence(hidden);
  EXPECT_GT(shown.total(), least_evidence());
  EXPECT_NEAR(shown.matched, without.matched, 2.0);
}

}  // namespace
}  // namespace lockbox
