// SPDX-License-Identifier: BSD-3-Clause
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <numbers>

#include "lockbox/core/yaml_map.hpp"
#include "lockbox/simulation/deviation.hpp"

namespace lockbox {
namespace {

constexpr double kMostSeeds = 9007199254740992.0;  // a double tells all whole numbers up to it

// Beyond these an object is no version of its model any more.
constexpr NumberRange kScale{0.5, 2.0, "must be a factor from 0.5 to 2"};
constexpr NumberRange kLength{0.0, 0.1, "must be from 0 to 0.1 (metres)"};
constexpr NumberRange kAngle{0.0, std::numbers::pi / 6.0, "must be from 0 to 0.52 (radians)"};
constexpr NumberRange kAddedShare{0.0, 0.5, "must be a share from 0 to 0.5"};
constexpr NumberRange kDepthShare{-0.2, 0.2, "must be from -0.2 to 0.2"};
constexpr NumberRange kFrameShare{0.0, 0.9, "must be a share from 0 to 0.9"};
constexpr NumberRange kRate{0.0, 1000.0, "must be from 0 (as they come) to 1000 (frames a second)"};
constexpr double kMostPixels = 100.0;  // that a principal point is off
constexpr double kMostDistortion = 0.5;

template <typename Integer>
void read_whole(const YamlMap& map, const char* key, double highest, Integer& value) {
  auto number = static_cast<double>(value);
  map.read(key, number);
  if (!(number >= 0.0 && number <= highest) || number != std::floor(number)) {
    map.refuse(key, "must be a whole number from 0 to " +
                        std::to_string(static_cast<std::uint64_t>(highest)));
  }
  value = static_cast<Integer>(number);
}

void read_object(const YamlValue& value, ObjectDeviation& object) {
  constexpr double kMostParts = 100.0;
  const YamlMap map(value, {"scale", "sizes", "bend", "joint_origins", "joint_axes", "added_parts",
                            "added_share", "missing_handles", "missing_parts"});
  map.read("scale", kScale, object.scale);
  map.read("sizes", kLength, object.sizes);
  map.read("bend", kLength, object.bend);
  map.read("joint_origins", kLength, object.joint_origins);
  map.read("joint_axes", kAngle, object.joint_axes);
  read_whole(map, "added_parts", kMostParts, object.added_parts);
  map.read("added_share", kAddedShare, object.added_share);
  read_whole(map, "missing_handles", kMostParts, object.missing_handles);
  map.read("missing_parts", object.missing_parts);
}

void read_camera(const YamlValue& value, CameraDeviation& camera) {
  const YamlMap map(value, {"focal_length", "principal_point", "distortion"});
  map.read("focal_length", kScale, camera.focal_length);
  map.read("principal_point", camera.principal_point);
  if (camera.principal_point.cwiseAbs().maxCoeff() > kMostPixels) {
    map.refuse("principal_point", "must be off by 100 pixels at most");
  }
  map.read("distortion", camera.distortion);
  if (camera.distortion.cwiseAbs().maxCoeff() > kMostDistortion) {
    map.refuse("distortion", "must be k1, k2 from -0.5 to 0.5");
  }
}

void read_depth(const YamlValue& value, DepthDeviation& depth) {
  const YamlMap map(value, {"scale", "bend", "corners"});
  map.read("scale", kScale, depth.scale);
  map.read("bend", kDepthShare, depth.bend);
  map.read("corners", kDepthShare, depth.corners);
}

void read_frames(const YamlValue& value, FrameDeviation& frames) {
  const YamlMap map(value, {"rate", "repeated", "missing"});
  map.read("rate", kRate, frames.rate);
  map.read("repeated", kFrameShare, frames.repeated);
  map.read("missing", kFrameShare, frames.missing);
}

void emit_pair(YAML::Emitter& out, const char* key, const Eigen::Vector2d& pair) {
  out << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginSeq << pair.x() << pair.y()
      << YAML::EndSeq;
}

void emit_sensor(YAML::Emitter& out, const SensorDeviation& sensor) {
  out << YAML::Key << "camera" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "focal_length" << YAML::Value << sensor.camera.focal_length;
  emit_pair(out, "principal_point", sensor.camera.principal_point);
  emit_pair(out, "distortion", sensor.camera.distortion);
  out << YAML::EndMap << YAML::Key << "depth" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "scale" << YAML::Value << sensor.depth.scale;
  out << YAML::Key << "bend" << YAML::Value << sensor.depth.bend;
  out << YAML::Key << "corners" << YAML::Value << sensor.depth.corners << YAML::EndMap;
}

void emit_frames(YAML::Emitter& out, const FrameDeviation& frames) {
  out << YAML::Key << "frames" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "rate" << YAML::Value << frames.rate;
  out << YAML::Key << "repeated" << YAML::Value << frames.repeated;
  out << YAML::Key << "missing" << YAML::Value << frames.missing << YAML::EndMap;
}

void emit_object(YAML::Emitter& out, const ObjectDeviation& object) {
  out << YAML::Key << "object" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "scale" << YAML::Value << object.scale;
  out << YAML::Key << "sizes" << YAML::Value << object.sizes;
  out << YAML::Key << "bend" << YAML::Value << object.bend;
  out << YAML::Key << "joint_origins" << YAML::Value << object.joint_origins;
  out << YAML::Key << "joint_axes" << YAML::Value << object.joint_axes;
  out << YAML::Key << "added_parts" << YAML::Value << object.added_parts;
  out << YAML::Key << "added_share" << YAML::Value << object.added_share;
  out << YAML::Key << "missing_handles" << YAML::Value << object.missing_handles;
  out << YAML::Key << "missing_parts" << YAML::Value << YAML::Flow << object.missing_parts;
  out << YAML::EndMap;
}

}  // namespace

Deviation read_deviation(const std::filesystem::path& path) {
  const YamlMap map(YamlValue::load(path, "deviation"),
                    {"seed", "object", "camera", "depth", "frames"});
  Deviation deviation;
  read_whole(map, "seed", kMostSeeds, deviation.seed);
  if (map.has("object")) read_object(map.value("object"), deviation.object);
  if (map.has("camera")) read_camera(map.value("camera"), deviation.sensor.camera);
  if (map.has("depth")) read_depth(map.value("depth"), deviation.sensor.depth);
  if (map.has("frames")) read_frames(map.value("frames"), deviation.frames);
  return deviation;
}

std::string deviation_text(const Deviation& deviation) {
  constexpr std::size_t kExactDigits = 17;
  YAML::Emitter out;
  out.SetDoublePrecision(kExactDigits);
  out << YAML::BeginMap << YAML::Key << "seed" << YAML::Value << deviation.seed;
  emit_object(out, deviation.object);
  emit_sensor(out, deviation.sensor);
  emit_frames(out, deviation.frames);
  out << YAML::EndMap;
  return std::string(out.c_str()) + '\n';
}

}  // namespace lockbox
