// SPDX-License-Identifier: BSD-3-Clause
// A gap of millimetres between two parts may be the object's, and not its joint's.
#include <gtest/gtest.h>

#include <string>

#include "initialization/seen_model.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/sensor/sensor_noise.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/verification/verifier.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

/// Two shells of 36 x 48 x 6 cm on each other, with a hinge along the back.
KinematicTree suitcase(double most_open) {
  const TemporaryFolder folder;
  return load_kinematic_tree(folder.write("suitcase.urdf", std::string(R"(<robot name="suitcase">
  <link name="base"><visual><origin xyz="0 0.03 0"/><geometry><box size="0.36 0.06 0.48"/></geometry></visual></link>
  <link name="shell"><visual><origin xyz="0.18 -0.03 0"/><geometry><box size="0.36 0.06 0.48"/></geometry></visual></link>
  <joint name="hinge" type="revolute"><parent link="base"/><child link="shell"/>
    <origin xyz="-0.18 0 0"/><axis xyz="0 0 -1"/>
    <limit lower="0" effort="1" velocity="1" upper=")") + std::to_string(most_open) +
                                                               R"("/></joint></robot>)"));
}

/// Looks at the side where it opens, 0.7 m away, open by that angle.
class Gap : public ::testing::Test {
 protected:
  explicit Gap(double most_open = 2.0) : tree_(suitcase(most_open)) {}

  Configuration open_by(double angle) const {
    Configuration configuration = rest_configuration(tree_);
    configuration.T_camera_base = Eigen::Translation3d(0.0, 0.0, 0.9) *
                                  Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(-2.0, Eigen::Vector3d::UnitZ());
    configuration.q[0] = angle;
    return configuration;
  }

  void look_at(double angle) {
    State state;
    state.configuration = open_by(angle);
    const SensorModel sensor = sensor_model("white");
    DepthFrame frame;
    Simulator(tree_, sensor.camera, {wall_behind(0.5), {state}}, sensor, 3, Executor())
        .simulate(state, 0, frame);
    TiledCloud cloud;
    cloud.assign(frame, {}, Executor());
    verifier_.look_at(cloud, SensorNoise{}, Executor());
  }

  const KinematicTree tree_;
  Verifier verifier_{tree_};
};

TEST_F(Gap, OfMillimetresSpeaksForNoJoint) {
  constexpr double kGap = 0.01;  // 3.6 mm at the opening
  look_at(kGap);
  const double open = verifier_.evidence(open_by(kGap)).total();
  const double closed = verifier_.evidence(open_by(0.0)).total();
  ASSERT_GT(open, closed + 5.0) << "or it does not show";
  EXPECT_EQ(verifier_.evidence_within_tolerance(open_by(kGap)).total(), closed);
}

TEST_F(Gap, OfCentimetresDoes) {
  constexpr double kOpen = 0.1;
  look_at(kOpen);
  EXPECT_EQ(verifier_.evidence_within_tolerance(open_by(kOpen)).total(),
            verifier_.evidence(open_by(kOpen)).total());
}

class GapOfAButton : public Gap {
 protected:
  static constexpr double kWay = 0.01;  // 3.6 mm at the opening
  GapOfAButton() : Gap(kWay) {}
};

/// Both ends of its range are within the tolerance.
TEST_F(GapOfAButton, IsNoReasonToDoubtThatItIsAtItsEnd) {
  look_at(kWay);
  const double open = verifier_.evidence(open_by(kWay)).total();
  ASSERT_GT(open, verifier_.evidence(open_by(0.0)).total() + 5.0) << "or it does not show";
  EXPECT_EQ(verifier_.evidence_within_tolerance(open_by(kWay)).total(), open);
}

}  // namespace
}  // namespace lockbox
