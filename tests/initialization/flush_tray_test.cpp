// SPDX-License-Identifier: BSD-3-Clause
// A tray that slides out just above a table may pass for it in a drawing.
#include <gtest/gtest.h>

#include "lockbox/core/units.hpp"
#include "lockbox/initialization/initializer.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "seen_model.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

/// On two feet, of 40 x 29 x 14 cm with a lid; the tray between the feet is 1.2 cm thick, and
/// 4 mm above the table. Turned back to front it looks much the same.
constexpr auto kPrinter = R"(<robot name="printer">
  <link name="base">
    <visual><origin xyz="0 0 0.097"/><geometry><box size="0.401 0.288 0.074"/></geometry></visual>
    <visual><origin xyz="0.18 0 0.03"/><geometry><box size="0.04 0.288 0.06"/></geometry></visual>
    <visual><origin xyz="-0.18 0 0.03"/><geometry><box size="0.04 0.288 0.06"/></geometry></visual>
    <visual><origin xyz="-0.12 -0.152 0.1"/><geometry><box size="0.08 0.015 0.04"/></geometry></visual>
  </link>
  <link name="lid">
    <visual><origin xyz="0 -0.134 0.01"/><geometry><box size="0.381 0.268 0.02"/></geometry></visual>
  </link>
  <link name="tray">
    <visual><origin xyz="0 0.12 0.006"/><geometry><box size="0.311 0.24 0.012"/></geometry></visual>
    <visual><origin xyz="0 0.006 0.0225"/><geometry><box size="0.311 0.012 0.045"/></geometry></visual>
  </link>
  <joint name="lid" type="revolute"><parent link="base"/><child link="lid"/>
    <origin xyz="0 0.134 0.135"/><axis xyz="-1 0 0"/>
    <limit lower="0" upper="1.4" effort="1" velocity="1"/></joint>
  <joint name="tray" type="prismatic"><parent link="base"/><child link="tray"/>
    <origin xyz="0 -0.144 0.004"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.2" effort="1" velocity="1"/></joint>
</robot>)";

struct SeenTray {
  double tilt;  ///< of the camera, radians
  double turn;  ///< of the printer about its upright axis, radians
  double open;  ///< metres
};

/// From above, so that the image shows the side of the tray.
class FlushTray : public ::testing::TestWithParam<SeenTray> {
 protected:
  FlushTray() {
    truth_.configuration = rest_configuration(model_.tree);
    truth_.configuration.T_camera_base =
        Eigen::Translation3d(0.1, 0.02, 0.83) *
        Eigen::AngleAxisd(GetParam().tilt, Eigen::Vector3d::UnitX()) *
        Eigen::Quaterniond(0.2936, 0.7896, -0.5139, 0.1623).normalized() *
        Eigen::AngleAxisd(GetParam().turn, Eigen::Vector3d::UnitZ());
    set_joint_position(model_.tree, truth_.configuration, "tray", GetParam().open);
    scene_.planes.push_back(
        {SceneFrame::base, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), {8.0, 8.0}});
  }

  Configuration found() {
    const SensorModel sensor = sensor_model("white");
    DepthFrame frame;
    Simulator(model_.tree, sensor.camera, PlacedScene(scene_, {truth_}), sensor, 2, Executor())
        .simulate(truth_, 0, frame);
    TiledCloud cloud;
    cloud.assign(frame, {}, Executor());
    const auto answers = Initializer(model_, {}, Executor()).find(cloud);
    return answers.empty() ? rest_configuration(model_.tree) : answers.front().configuration;
  }

  const ArticulatedModel model_ =
      load_model(TemporaryFolder().write("printer.urdf", kPrinter), with_cache());
  State truth_;
  Scene scene_;
};

TEST_P(FlushTray, IsFoundWhereItIs) {
  const Configuration answer = found();
  const Eigen::Isometry3d error =
      truth_.configuration.T_camera_base.inverse() * answer.T_camera_base;
  EXPECT_LT(error.translation().norm(), 0.01);
  EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 2.0 * kRadians);
  const int tray = joint_index(model_.tree, "tray");
  EXPECT_NEAR(joint_position(model_.tree, answer, tray), GetParam().open, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Views, FlushTray,
                         ::testing::Values(SeenTray{-0.3, -0.35, 0.0}, SeenTray{-0.18, -0.05, 0.0},
                                           SeenTray{0.0, -0.35, 0.12}));

}  // namespace
}  // namespace lockbox
