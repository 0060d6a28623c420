// SPDX-License-Identifier: BSD-3-Clause
#include "model_parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

#include "lockbox/core/error.hpp"
#include "lockbox/core/readable_text.hpp"
#include "lockbox/core/text_file.hpp"
#include "lockbox/core/yaml_value.hpp"
#include "model_keys.hpp"
#include "quaternion_tolerance.hpp"

namespace lockbox {
namespace {

/// Neither a voxel nor an erosion is that large, metres: a camera sees things of a few metres.
/// Twice as much lets more pass that is in millimetres.
constexpr double kLargestDetail = 0.1;

void require_metres(const YamlValue& node, double value, double most) {
  if (std::abs(value) <= most) return;
  node.refuse(readable_length(std::abs(value)) + " is too much; lengths are in metres: if " +
              "millimetres are meant, write " + readable_number(0.001 * value));
}

double positive_length(const YamlValue& node) {
  const double value = node.number();
  require_metres(node, value, kLargestDetail);
  if (value <= 0.0) node.refuse("a length in metres must be positive");
  return value;
}

double erosion_depth(const YamlValue& node) {
  const double value = node.number();
  require_metres(node, value, kLargestDetail);
  if (value < 0.0) node.refuse("an erosion (metres) must not be negative");
  return value;
}

/// The body that the named link is part of.
const Body& body_of(const YamlValue& where, const std::string& link, const KinematicTree& tree) {
  for (const Body& body : tree.bodies) {
    if (std::find(body.links.begin(), body.links.end(), link) == body.links.end()) continue;
    if (body.visuals.empty()) where.refuse("link " + in_quotes(link) + " has no geometry");
    return body;
  }
  where.refuse("the model has no link " + in_quotes(link));
}

std::map<std::string, double> read_link_voxels(const YamlValue& node, const KinematicTree& tree) {
  std::map<std::string, double> voxels;
  for (const auto& [name, value] : node.entries()) {
    const std::string link = name.text();
    const std::string& body = body_of(value, link, tree).name;
    if (!voxels.emplace(body, positive_length(value)).second) {
      value.refuse("link " + in_quotes(link) + " belongs to the rigid body " + in_quotes(body) +
                   ", which has a voxel size already");
    }
  }
  return voxels;
}

void read_pair_erosion(const YamlValue& node, const KinematicTree& tree, ModelParameters& result) {
  std::vector<std::string> bodies;
  std::optional<double> erosion;
  for (const auto& [name, value] : node.entries()) {
    const std::string key = name.text();
    if (key == "links") {
      for (const YamlValue& link : value.items(2)) {
        bodies.push_back(body_of(link, link.text(), tree).name);
      }
    } else if (key == "erosion") {
      erosion = erosion_depth(value);
    } else {
      name.refuse("unknown key " + in_quotes(key) + "; a pair has the keys links, erosion");
    }
  }
  if (bodies.empty() || !erosion) node.refuse("a pair needs both keys, links and erosion");
  std::sort(bodies.begin(), bodies.end());
  if (bodies[0] == bodies[1]) node.refuse("the two links are one rigid body, which cannot collide");
  if (!result.pair_erosion.emplace(std::pair{bodies[0], bodies[1]}, *erosion).second) {
    node.refuse("the pair of bodies " + in_quotes(bodies[0]) + " and " + in_quotes(bodies[1]) +
                " stands there twice");
  }
}

template <std::size_t Count>
std::array<double, Count> numbers(const YamlValue& node) {
  std::array<double, Count> result{};
  const auto items = node.items(Count);
  std::transform(items.begin(), items.end(), result.begin(),
                 [](const YamlValue& item) { return item.number(); });
  return result;
}

Eigen::Quaterniond rotation(const YamlValue& node) {
  const auto [x, y, z, w] = numbers<4>(node);
  const Eigen::Quaterniond q(w, x, y, z);
  if (!(std::abs(q.norm() - 1.0) <= kQuaternionTolerance)) {
    node.refuse("the quaternion [qx, qy, qz, qw] has norm " + readable_number(q.norm()) +
                ", not 1");
  }
  return q.normalized();
}

void set_joint(const YamlValue& node, const std::string& joint, const KinematicTree& tree,
               Configuration& configuration) {
  constexpr int kDigits = 6;
  const double position = node.number();
  try {
    set_joint_position(tree, configuration, joint, position);
  } catch (const InputError& error) {
    node.refuse(error.what());
  }
  const VariableLimits limits = variable_limits(
      tree, tree.joints[static_cast<std::size_t>(joint_index(tree, joint))].variable);
  if (position < limits.lower || position > limits.upper) {
    node.refuse("joint " + in_quotes(joint) + " moves between " +
                readable_number(limits.lower, kDigits) + " and " +
                readable_number(limits.upper, kDigits));
  }
}

Configuration read_initial_state(const YamlValue& node, const KinematicTree& tree) {
  Configuration result = rest_configuration(tree);
  for (const auto& [name, value] : node.entries()) {
    const std::string key = name.text();
    if (key == "position") {
      const auto [x, y, z] = numbers<3>(value);
      for (const YamlValue& item : value.items(3)) {
        require_metres(item, item.number(), kFarthestBase);
      }
      result.T_camera_base.translation() = Eigen::Vector3d(x, y, z);
    } else if (key == "quaternion") {
      result.T_camera_base.linear() = rotation(value).toRotationMatrix();
    } else if (key == "joints") {
      for (const auto& [joint, position] : value.entries()) {
        set_joint(position, joint.text(), tree, result);
      }
    } else {
      name.refuse("unknown key " + in_quotes(key) +
                  "; an initial state has the keys position, quaternion, joints");
    }
  }
  return result;
}

}  // namespace

ModelParameters read_model_parameters(const std::filesystem::path& yaml, const KinematicTree& tree,
                                      const std::function<void(const std::string&)>& on_warning) {
  ModelParameters result;
  std::error_code error;  // e.g. a folder that may not be entered: no such file, as far as we know
  if (!std::filesystem::is_regular_file(yaml, error)) return result;
  if (!names_model_keys(yaml.string(), read_text_file(yaml))) {
    if (on_warning) {
      on_warning(yaml.string() + ": not read, because it holds none of the keys " + kKeyList);
    }
    return result;
  }
  const YamlValue top = YamlValue::load(yaml, "YAML");
  if (top.is_empty()) return result;
  for (const auto& [name, value] : top.entries()) {
    const std::string key = name.text();
    if (key == "voxel") {
      result.voxel = positive_length(value);
    } else if (key == "link_voxel") {
      result.link_voxel = read_link_voxels(value, tree);
    } else if (key == "erosion") {
      result.erosion = erosion_depth(value);
    } else if (key == "pair_erosion") {
      for (const YamlValue& pair : value.items()) read_pair_erosion(pair, tree, result);
    } else if (key == "initial_state") {
      result.initial_configuration = read_initial_state(value, tree);
    } else {
      name.refuse("unknown key " + in_quotes(key) + "; a model has the keys " + kKeyList);
    }
  }
  return result;
}

}  // namespace lockbox
