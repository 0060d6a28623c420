// SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <string>

#include "lockbox/core/yaml_map.hpp"
#include "lockbox/simulation/scene.hpp"

namespace lockbox {
namespace {

void read_frame(const YamlMap& map, SceneFrame& frame) {
  std::string name = frame == SceneFrame::world ? "world" : "base";
  map.read("frame", name);
  if (name != "world" && name != "base") {
    map.refuse("frame", "must be world or base");
  }
  frame = name == "world" ? SceneFrame::world : SceneFrame::base;
}

void read_length(const YamlMap& map, const char* key, double& length) {
  map.read(key, length);
  if (map.has(key) && length <= 0.0) {
    map.refuse(key, "must be positive (metres)");
  }
}

ScenePlane read_plane(const YamlValue& value) {
  const YamlMap map(value, {"frame", "point", "normal", "extent"});
  ScenePlane plane;
  map.require("point");
  map.require("normal");
  read_frame(map, plane.frame);
  map.read("point", plane.point);
  map.read("normal", plane.normal);
  map.read("extent", plane.extent);
  if (plane.normal.norm() < 1e-9) {
    map.refuse("normal", "must not be zero");
  }
  if (plane.extent.minCoeff() <= 0.0) {
    map.refuse("extent", "must be positive (metres)");
  }
  return plane;
}

SceneBox read_box(const YamlValue& value) {
  const YamlMap map(value, {"frame", "size", "position", "quaternion"});
  SceneBox box;
  map.require("size");
  map.require("position");
  read_frame(map, box.frame);
  map.read("size", box.size);
  if (box.size.minCoeff() <= 0.0) {
    map.refuse("size", "must be positive (metres)");
  }
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  map.read("position", position);
  Eigen::Vector4d xyzw = Eigen::Vector4d::UnitW();
  map.read("quaternion", xyzw);
  if (xyzw.norm() < 1e-9) {
    map.refuse("quaternion", "must be qx, qy, qz, qw, not all zero");
  }
  box.pose.translation() = position;
  box.pose.linear() = Eigen::Quaterniond(xyzw).normalized().toRotationMatrix();
  return box;
}

ArmWaypoint read_waypoint(const YamlValue& value, double earliest) {
  const YamlMap map(value, {"time", "shoulder", "wrist"});
  ArmWaypoint waypoint;
  map.require("time");
  map.require("shoulder");
  map.require("wrist");
  map.read("time", waypoint.time);
  map.read("shoulder", waypoint.shoulder);
  map.read("wrist", waypoint.wrist);
  if (!(waypoint.time > earliest) || waypoint.time > 1.0) {
    map.refuse("time", "must grow from waypoint to waypoint, from 0 to 1 at most");
  }
  return waypoint;
}

SceneArm read_arm(const YamlValue& value) {
  const YamlMap map(value, {"frame", "upper_arm", "forearm", "hand", "radius", "elbow", "torso",
                            "torso_radius", "waypoints"});
  SceneArm arm;
  read_frame(map, arm.frame);
  read_length(map, "upper_arm", arm.upper_arm);
  read_length(map, "forearm", arm.forearm);
  read_length(map, "hand", arm.hand);
  read_length(map, "radius", arm.radius);
  read_length(map, "torso_radius", arm.torso_radius);
  map.read("elbow", arm.elbow);
  map.read("torso", arm.torso);
  double earliest = -1e-9;
  for (const YamlValue& item : map.items("waypoints")) {
    arm.waypoints.push_back(read_waypoint(item, earliest));
    earliest = arm.waypoints.back().time;
  }
  if (arm.waypoints.size() < 2) {
    map.refuse("waypoints", "must hold at least two waypoints");
  }
  return arm;
}

std::optional<Eigen::AlignedBox3d> read_room(const YamlMap& scene) {
  if (!scene.has("room")) return std::nullopt;
  const YamlMap map(scene.value("room"), {"lower", "upper"});
  map.require("lower");
  map.require("upper");
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();
  map.read("lower", lower);
  map.read("upper", upper);
  if ((upper - lower).minCoeff() <= 0.0) map.refuse("upper", "must be above lower (metres)");
  return Eigen::AlignedBox3d(lower, upper);
}

}  // namespace

Scene read_scene(const std::filesystem::path& path) {
  const YamlMap map(YamlValue::load(path, "scene"), {"moving", "room", "planes", "boxes", "arms"});
  Scene scene;
  std::string moving = "object";
  map.read("moving", moving);
  if (moving != "object" && moving != "camera") {
    map.refuse("moving", "must be object or camera");
  }
  scene.moving = moving == "object" ? Moving::object : Moving::camera;
  scene.room = read_room(map);
  for (const YamlValue& value : map.items("planes")) {
    scene.planes.push_back(read_plane(value));
  }
  for (const YamlValue& value : map.items("boxes")) {
    scene.boxes.push_back(read_box(value));
  }
  for (const YamlValue& value : map.items("arms")) {
    scene.arms.push_back(read_arm(value));
  }
  return scene;
}

}  // namespace lockbox
