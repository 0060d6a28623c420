// SPDX-License-Identifier: BSD-3-Clause
#include "seen_model.hpp"

#include <map>

#include "lockbox/simulation/simulator.hpp"
#include "lockbox/simulation/trajectory.hpp"

namespace lockbox {

std::filesystem::path shipped_file(const std::string& name) {
  return std::filesystem::path(LOCKBOX_MODELS) / name / (name + ".urdf");
}

LoadOptions with_cache() {
  LoadOptions options;
  options.cache_directory = LOCKBOX_CACHE;
  return options;
}

const ArticulatedModel& shipped(const std::string& name) {
  static std::map<std::string, ArticulatedModel> models;
  const auto known = models.find(name);
  if (known != models.end()) return known->second;
  return models.emplace(name, load_model(shipped_file(name), with_cache())).first->second;
}

Configuration facing(const ArticulatedModel& model, double distance, double tilt, double roll) {
  Configuration configuration = rest_configuration(model.tree);
  configuration.T_camera_base = facing_pose(distance) *
                                Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ());
  return configuration;
}

DepthFrame seen_frame(const ArticulatedModel& model, const Configuration& truth, const Scene& scene,
                      std::uint64_t number) {
  const PinholeCamera camera{640, 480, 575.8, 575.8, 319.5, 239.5};
  State state;
  state.configuration = truth;
  DepthFrame frame;
  Simulator(model.tree, camera, {scene, {state}}, sensor_model("primesense"), 3, Executor())
      .simulate(state, number, frame);
  return frame;
}

TiledCloud seen(const ArticulatedModel& model, const Configuration& truth, const Scene& scene,
                std::uint64_t number) {
  TiledCloud cloud;
  cloud.assign(seen_frame(model, truth, scene, number), {}, Executor());
  return cloud;
}

Scene wall_behind(double distance) {
  Scene scene;
  scene.planes.push_back(
      {SceneFrame::base, {0.0, 0.0, -distance}, Eigen::Vector3d::UnitZ(), {8.0, 8.0}});
  return scene;
}

}  // namespace lockbox
