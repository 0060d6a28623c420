// SPDX-License-Identifier: BSD-3-Clause
// Contours that stand out by less than the noise of a cell.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "initialization/seen_model.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/sensor/sensor_model.hpp"
#include "lockbox/sensor/sensor_noise.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/verification/verifier.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

KinematicTree shaped(const std::string& geometry) {
  const TemporaryFolder folder;
  std::ofstream(folder / "thing.urdf")
      << "<robot name=\"thing\"><link name=\"thing\"><visual><geometry>" << geometry
      << "</geometry></visual></link></robot>";
  return load_kinematic_tree(folder / "thing.urdf");
}

/// Its front is z = 6 mm.
KinematicTree board() {
  return shaped("<box size=\"0.6 0.5 0.012\"/>");
}

/// At 1.4 m, aslant.
Configuration aslant(const KinematicTree& tree) {
  Configuration configuration = rest_configuration(tree);
  configuration.T_camera_base =
      Eigen::Translation3d(0.0, 0.0, 1.4) *
      Eigen::AngleAxisd(M_PI + 0.3, Eigen::Vector3d(1.0, 0.3, 0.0).normalized());
  return configuration;
}

Verifier seen_by(const KinematicTree& with, const KinematicTree& thing, const Configuration& where,
                 const Scene& scene, std::uint64_t seed) {
  State state;
  state.configuration = where;
  DepthFrame frame;
  const SensorModel sensor = sensor_model("primesense");
  Simulator(thing, sensor.camera, {scene, {state}}, sensor, seed, Executor())
      .simulate(state, 0, frame);
  TiledCloud cloud;
  cloud.assign(frame, {}, Executor());
  Verifier verifier(with);
  verifier.look_at(cloud, SensorNoise{}, Executor());
  return verifier;
}

class FaintStepsTest : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  const KinematicTree plate = board();
  /// The board's back lies in it.
  const Scene wall = wall_behind(0.006);
};

TEST_P(FaintStepsTest, TellABoardOnAWallByAllOfItsContour) {
  const Configuration truth = aslant(plate);
  Verifier verifier = seen_by(plate, plate, truth, wall, GetParam());
  const Evidence evidence = verifier.evidence(truth);
  EXPECT_GT(evidence.matched + evidence.contradicted, 5.0)
      << evidence.matched << ' ' << evidence.contradicted;
}

TEST_P(FaintStepsTest, AreNotSeenInABareWall) {
  const KinematicTree nothing = shaped("<box size=\"0.01 0.01 0.01\"/>");
  Configuration aside = aslant(nothing);
  aside.T_camera_base.translate(Eigen::Vector3d(2.0, 0.0, 0.0));
  Verifier verifier = seen_by(plate, nothing, aside, wall, GetParam());
  const Evidence evidence = verifier.evidence(aslant(plate));
  EXPECT_LT(evidence.matched, 2.0);
  EXPECT_LT(evidence.contradicted, -10.0);
}

TEST_P(FaintStepsTest, AreNotSeenBesideWhereTheyAre) {
  Verifier verifier = seen_by(plate, plate, aslant(plate), wall, GetParam());
  Configuration beside = aslant(plate);
  beside.T_camera_base.translate(Eigen::Vector3d(0.15, 0.0, 0.0));
  const Evidence evidence = verifier.evidence(beside);
  EXPECT_LT(evidence.matched + evidence.contradicted, 0.0)
      << evidence.matched << ' ' << evidence.contradicted;
}

/// A pillar of a metre across: its surface bends, and steps nowhere.
TEST_P(FaintStepsTest, AreNotTakenForABend) {
  const KinematicTree pillar = shaped("<cylinder radius=\"0.5\" length=\"3\"/>");
  Configuration standing = rest_configuration(pillar);
  standing.T_camera_base =
      Eigen::Translation3d(0.0, 0.0, 1.9) * Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitX());
  Verifier verifier = seen_by(plate, pillar, standing, wall_behind(3.0), GetParam());
  Configuration leaning = rest_configuration(plate);
  leaning.T_camera_base =
      Eigen::Translation3d(0.0, 0.0, 1.42) * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
  const Evidence evidence = verifier.evidence(leaning);
  EXPECT_LT(evidence.matched + evidence.contradicted, 0.0)
      << evidence.matched << ' ' << evidence.contradicted;
}

INSTANTIATE_TEST_SUITE_P(Noise, FaintStepsTest, ::testing::Values(1, 2, 3));

}  // namespace
}  // namespace lockbox
