// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "lockbox/simulation/deviation.hpp"
#include "yaml_map.hpp"

namespace lockbox {
namespace {

using simulation::YamlMap;

constexpr double kMostSeeds = 9007199254740992.0;  // a double tells all whole numbers up to it

/// A number from lowest to highest, or else what is wrong with it.
struct Range {
  double lowest;
  double highest;
  const char* demand;
};

// Beyond these an object is no version of its model any more.
constexpr Range kScale{0.5, 2.0, "must be a factor from 0.5 to 2"};
constexpr Range kLength{0.0, 0.1, "must be from 0 to 0.1 (metres)"};
constexpr Range kAngle{0.0, std::numbers::pi / 6.0, "must be from 0 to 0.52 (radians)"};
constexpr Range kAddedShare{0.0, 0.5, "must be a share from 0 to 0.5"};

void read_within(const YamlMap& map, const char* key, const Range& range, double& value) {
  map.read(key, value);
  if (!(value >= range.lowest && value <= range.highest)) map.refuse(key, range.demand);
}

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

void read_object(const std::string& file, const YAML::Node& node, ObjectDeviation& object) {
  constexpr double kMostParts = 100.0;
  const YamlMap map(file, node,
                    {"scale", "sizes", "joint_origins", "joint_axes", "added_parts", "added_share",
                     "missing_handles", "missing_parts"});
  read_within(map, "scale", kScale, object.scale);
  read_within(map, "sizes", kLength, object.sizes);
  read_within(map, "joint_origins", kLength, object.joint_origins);
  read_within(map, "joint_axes", kAngle, object.joint_axes);
  read_whole(map, "added_parts", kMostParts, object.added_parts);
  read_within(map, "added_share", kAddedShare, object.added_share);
  read_whole(map, "missing_handles", kMostParts, object.missing_handles);
  map.read("missing_parts", object.missing_parts);
}

void emit_object(YAML::Emitter& out, const ObjectDeviation& object) {
  out << YAML::Key << "object" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "scale" << YAML::Value << object.scale;
  out << YAML::Key << "sizes" << YAML::Value << object.sizes;
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
  const std::string file = path.string();
  const YamlMap map(file, simulation::load_yaml(path, "deviation"), {"seed", "object"});
  Deviation deviation;
  read_whole(map, "seed", kMostSeeds, deviation.seed);
  if (map.has("object")) read_object(file, map.node("object"), deviation.object);
  return deviation;
}

std::string deviation_text(const Deviation& deviation) {
  constexpr std::size_t kExactDigits = 17;
  YAML::Emitter out;
  out.SetDoublePrecision(kExactDigits);
  out << YAML::BeginMap << YAML::Key << "seed" << YAML::Value << deviation.seed;
  emit_object(out, deviation.object);
  out << YAML::EndMap;
  return std::string(out.c_str()) + '\n';
}

}  // namespace lockbox
