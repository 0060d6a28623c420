// SPDX-License-Identifier: BSD-3-Clause
#include "mechanism.hpp"

#include "lockbox/core/lie.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

std::string robot_text(const std::vector<std::string>& elements) {
  std::string text = "<robot name=\"mechanism\">\n";
  for (const std::string& element : elements) text += element + '\n';
  return text + "</robot>\n";
}

}  // namespace

std::vector<std::string> mechanism_elements() {
  return {
      R"(<link name="plate"><visual><geometry><box size="0.4 0.4 0.02"/></geometry></visual></link>)",
      R"(<link name="block"><visual><geometry><box size="0.08 0.06 0.05"/></geometry></visual></link>)",
      R"(<link name="arm">
    <visual><origin xyz="0.06 0 0"/><geometry><box size="0.16 0.04 0.02"/></geometry></visual>
  </link>)",
      R"(<link name="knob">
    <visual><geometry><cylinder radius="0.015" length="0.05"/></geometry></visual>
    <visual><origin xyz="0 0 0.03"/><geometry><box size="0.04 0.05 0.02"/></geometry></visual>
  </link>)",
      R"(<link name="follower"><visual><geometry><box size="0.05 0.05 0.03"/></geometry></visual></link>)",
      R"(<joint name="slide" type="prismatic">
    <parent link="plate"/><child link="block"/><origin xyz="-0.05 0.05 0.035"/>
    <axis xyz="1 0 0"/><limit lower="-0.08" upper="0.08" effort="1" velocity="1"/>
  </joint>)",
      R"(<joint name="turn" type="revolute">
    <parent link="block"/><child link="arm"/><origin xyz="0 0 0.035"/>
    <axis xyz="0 0 1"/><limit lower="-1.2" upper="1.2" effort="1" velocity="1"/>
  </joint>)",
      R"(<joint name="twist" type="continuous">
    <parent link="arm"/><child link="knob"/><origin xyz="0.1 0 0.035" rpy="0 0 0.4"/>
    <axis xyz="0 0 1"/>
  </joint>)",
      R"(<joint name="follow" type="prismatic">
    <parent link="plate"/><child link="follower"/><origin xyz="0.14 -0.08 0.025"/>
    <axis xyz="0 1 0"/><limit lower="-0.1" upper="0.1" effort="1" velocity="1"/>
    <mimic joint="slide" multiplier="0.8" offset="0.01"/>
  </joint>)"};
}

ArticulatedModel load_mechanism(const std::vector<std::string>& elements,
                                const LoadOptions& options) {
  const TemporaryFolder folder;
  return load_model(folder.write("mechanism.urdf", robot_text(elements)), options);
}

KinematicTree load_mechanism_tree(const std::vector<std::string>& elements) {
  const TemporaryFolder folder;
  return load_kinematic_tree(folder.write("mechanism.urdf", robot_text(elements)), {});
}

const ArticulatedModel& mechanism() {
  static const ArticulatedModel model = [] {
    LoadOptions without_cache;
    without_cache.cache_directory = std::filesystem::path();
    return load_mechanism(mechanism_elements(), without_cache);
  }();
  return model;
}

const ArticulatedModel& bracket() {
  static const ArticulatedModel model = [] {
    LoadOptions without_cache;
    without_cache.cache_directory = std::filesystem::path();
    return load_mechanism({R"(<link name="bracket">
    <visual><geometry><box size="0.24 0.08 0.03"/></geometry></visual>
    <visual><origin xyz="0.1 0.08 0"/><geometry><box size="0.04 0.12 0.03"/></geometry></visual>
    <visual><origin xyz="-0.09 0 0.05"/><geometry><box size="0.05 0.05 0.09"/></geometry></visual>
  </link>)"},
                          without_cache);
  }();
  return model;
}

Configuration mechanism_start(const ArticulatedModel& model) {
  Configuration configuration = rest_configuration(model.tree);
  Eigen::Isometry3d facing = Eigen::Isometry3d::Identity();
  facing.linear() = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  facing.translation() = Eigen::Vector3d(0.01, -0.02, 0.7);
  Twist tilt;
  tilt << 0.0, 0.0, 0.0, 0.3, -0.2, 0.1;
  configuration.T_camera_base = facing * exp_se3(tilt);
  if (model.tree.joints.empty()) return configuration;
  set_joint_position(model.tree, configuration, "slide", 0.02);
  set_joint_position(model.tree, configuration, "turn", 0.3);
  set_joint_position(model.tree, configuration, "twist", -0.5);
  return configuration;
}

DepthFrame measured(const ArticulatedModel& model, const Configuration& configuration,
                    const std::string& sensor, std::uint64_t seed) {
  const PinholeCamera camera{320, 240, 287.9, 287.9, 159.5, 119.5};
  State state;
  state.configuration = configuration;
  // A wall behind: without it pixels beside the mechanism are unknown, and its contour is too.
  Scene scene;
  scene.planes.push_back({SceneFrame::world, {0.0, 0.0, 1.3}, {0.0, 0.0, -1.0}, {5.0, 5.0}});
  Simulator simulator(model.tree, camera, PlacedScene(scene, {state}), sensor_model(sensor), seed,
                      Executor(1));
  DepthFrame frame;
  simulator.simulate(state, 0, frame);
  return frame;
}

TiledCloud cloud_of(const DepthFrame& frame) {
  TiledCloud cloud;
  cloud.assign(frame, CloudOptions{}, Executor(1));
  return cloud;
}

}  // namespace lockbox
