// SPDX-License-Identifier: BSD-3-Clause
// Property "one set of weights": the same weights serve small and large objects, and images of few
// and of many pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "initialization/seen_model.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

struct Setting {
  double size;  ///< of the box, metres
  int width;    ///< of the image, pixels
  int height;
};

void PrintTo(const Setting& setting, std::ostream* stream) {
  *stream << setting.size << " m at " << setting.width << " x " << setting.height;
}

/// A box with a drawer and a door before it, all in flush contact.
ArticulatedModel chest(double size) {
  const auto box = [&](double x, double y, double z) {
    return "<visual><geometry><box size=\"" + std::to_string(x * size) + " " +
           std::to_string(y * size) + " " + std::to_string(z * size) +
           "\"/></geometry></visual></link>";
  };
  const auto origin = [&](double x, double y, double z) {
    return "<origin xyz=\"" + std::to_string(x * size) + " " + std::to_string(y * size) + " " +
           std::to_string(z * size) + "\"/>";
  };
  const std::string reach = std::to_string(0.4 * size);
  return load_mechanism(
      {"<link name=\"chest\">" + box(1.0, 0.8, 0.5), "<link name=\"drawer\">" + box(0.4, 0.3, 0.3),
       "<link name=\"door\">" +
           std::string("<visual>" + origin(0.2, 0.0, 0.0) + "<geometry><box size=\"" +
                       std::to_string(0.4 * size) + " " + std::to_string(0.6 * size) + " " +
                       std::to_string(0.1 * size) + "\"/></geometry></visual></link>"),
       "<joint name=\"pull\" type=\"prismatic\"><parent link=\"chest\"/><child link=\"drawer\"/>" +
           origin(0.25, 0.0, 0.4) + "<axis xyz=\"0 1 0\"/><limit lower=\"-" + reach +
           "\" upper=\"" + reach + "\" effort=\"1\" velocity=\"1\"/></joint>",
       "<joint name=\"swing\" type=\"revolute\"><parent link=\"chest\"/><child link=\"door\"/>" +
           origin(-0.45, 0.0, 0.3) +
           "<axis xyz=\"0 -1 0\"/><limit lower=\"0\" upper=\"2\" effort=\"1\" "
           "velocity=\"1\"/></joint>"},
      with_cache());
}

class OneSetOfWeights : public ::testing::TestWithParam<Setting> {};

TEST_P(OneSetOfWeights, ServesEverySizeAndResolution) {
  const auto& [size, width, height] = GetParam();
  const ArticulatedModel model = chest(size);
  const double f = 0.9 * width;
  const PinholeCamera camera{width, height, f, f, 0.5 * (width - 1), 0.5 * (height - 1)};
  State state;
  state.configuration = rest_configuration(model.tree);
  state.configuration.T_camera_base =
      facing_pose(0.4 + 1.3 * size) *
      Eigen::AngleAxisd(0.4, Eigen::Vector3d(1.0, 0.7, 0.1).normalized());
  set_joint_position(model.tree, state.configuration, "pull", 0.05 * size);
  set_joint_position(model.tree, state.configuration, "swing", 0.5);
  DepthFrame frame;
  Simulator(model.tree, camera, {wall_behind(0.6 * size), {state}}, sensor_model("white"), 3,
            Executor())
      .simulate(state, 0, frame);
  TiledCloud cloud;
  cloud.assign(frame, {}, Executor());

  Eigen::VectorXd step(8);
  step << 0.02, -0.02, 0.015, 0.03, 0.03, -0.03, 0.02, 0.04;
  step.head<3>() *= size;
  const bool door_first = model.tree.joints[0].name == "swing";
  step[door_first ? 7 : 6] = 0.02 * size;
  step[door_first ? 6 : 7] = 0.04;
  ArticulatedRegistration registration(model, {}, Executor());
  const RegistrationResult& found =
      registration.align(cloud, stepped(state.configuration, step), {0.03 * size, 30});
  Eigen::VectorXd error(8);
  error << log_se3(state.configuration.T_camera_base.inverse() * found.configuration.T_camera_base),
      found.configuration.q - state.configuration.q;
  const double pixel = state.configuration.T_camera_base.translation().z() / f;
  EXPECT_LT(error.head<3>().norm(), std::max(pixel, 0.01 * size));
  EXPECT_LT(error.segment<3>(3).norm(), std::max(pixel / size, 0.01));
  EXPECT_LT(std::abs(error[door_first ? 7 : 6]), std::max(pixel, 0.01 * size));
  EXPECT_LT(std::abs(error[door_first ? 6 : 7]), std::max(pixel / (0.4 * size), 0.01));
  EXPECT_GT(found.agreement.explained, 0.7);
  EXPECT_LT(found.agreement.contradicted, 0.05);  // up to 0.042 over 12 seeds at 80 pixels
}

INSTANTIATE_TEST_SUITE_P(Of, OneSetOfWeights,
                         ::testing::Values(Setting{0.2, 80, 60}, Setting{0.2, 1280, 1024},
                                           Setting{2.0, 80, 60}, Setting{2.0, 1280, 1024}),
                         [](const auto& setting) {
                           return (setting.param.size < 1.0 ? "small_box_" : "large_cabinet_") +
                                  std::to_string(setting.param.width) + "_pixels";
                         });

}  // namespace
}  // namespace lockbox
