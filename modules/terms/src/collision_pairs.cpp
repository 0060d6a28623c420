// SPDX-License-Identifier: BSD-3-Clause
#include "collision_pairs.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

#include "lockbox/core/error.hpp"
#include "lockbox/model/variable_range.hpp"
#include "lockbox/sdf/distance_rounding.hpp"

namespace lockbox {
namespace {

constexpr double kThicknessShare = 0.125;              // of the thinner body: the largest erosion
constexpr double kWholeTurn = 2.0 * std::numbers::pi;  // radians
constexpr double kRounding = 0.01;  // radians: 3.14 and 6.28 stand for half and whole turns
constexpr int kRangeSteps = 8;      // of a joint: halved, what overlaps at few angles may be missed

/// The joint that joins two bodies, none of which carries a third between them; or none.
const Joint* joint_between(const KinematicTree& tree, int a, int b) {
  const auto found = std::find_if(tree.joints.begin(), tree.joints.end(), [&](const Joint& joint) {
    return std::minmax(joint.parent_body, joint.child_body) == std::minmax(a, b);
  });
  return found != tree.joints.end() && found->variable >= 0 ? &*found : nullptr;
}

/// How deep one of the bodies reaches into the other, metres. whole: the surfaces of bodies that
/// have a field.
double overlap(const ArticulatedModel& model, const std::vector<ErodedSurface>& whole,
               const CollisionPair& pair, const BodyPoses& T_camera_body) {
  const auto a = static_cast<std::size_t>(pair.a);
  const auto b = static_cast<std::size_t>(pair.b);
  const Eigen::Isometry3d T_b_a = T_camera_body[b].inverse() * T_camera_body[a];
  return std::max(whole[a].deepest_in(*model.fields[b], T_b_a),
                  whole[b].deepest_in(*model.fields[a], T_b_a.inverse()));
}

/// Bodies that turn about a joint, and overlap somewhere between its limits, are drawn into each
/// other (the links of an arm about their elbow): its limits say where they may be, not their
/// surfaces. A joint that may go all the way round has none: only its frame holds a door then.
/// allowed: metres of overlap that cost nothing.
bool is_drawn_into(const ArticulatedModel& model, const std::vector<ErodedSurface>& whole,
                   const CollisionPair& pair, double allowed) {
  const Joint* const joint = joint_between(model.tree, pair.a, pair.b);
  if (joint == nullptr || joint->type == JointType::prismatic) return false;  // may meet a stop
  const VariableRange range = variable_range(model.tree, joint->variable);
  if (range.extent() >= kWholeTurn - kRounding) return false;
  const auto positions = positions_in(range, kRangeSteps);
  Configuration configuration = rest_configuration(model.tree);
  BodyPoses poses;
  return std::any_of(positions.begin(), positions.end(), [&](double position) {
    configuration.q[joint->variable] = position;
    forward_kinematics(model.tree, configuration, poses);
    return overlap(model, whole, pair, poses) > allowed;
  });
}

/// The erosion that the model's file sets for a pair, by any of the links' names.
std::optional<double> pair_erosion(const ArticulatedModel& model, const Body& a, const Body& b) {
  for (const std::string& link_a : a.links) {
    for (const std::string& link_b : b.links) {
      const auto found = model.parameters.pair_erosion.find(std::minmax(link_a, link_b));
      if (found != model.parameters.pair_erosion.end()) {
        return found->second;
      }
    }
  }
  return std::nullopt;
}

/// The erosion that the model's file sets for these bodies, if any. largest: metres.
std::optional<double> chosen_erosion(const ArticulatedModel& model, const Body& a, const Body& b,
                                     double largest) {
  auto chosen = pair_erosion(model, a, b);
  chosen = chosen ? chosen : model.parameters.erosion;
  if (chosen && *chosen > largest) {
    throw InputError(
        model.file.string(),
        "the erosion of " + std::to_string(*chosen * 1e3) + " mm for links '" + a.name + "' and '" +
            b.name + "' is more than an eighth of the thinner one (" +
            std::to_string(largest * 1e3) +
            " mm): its eroded surface would vanish; lower it in the model's YAML file");
  }
  return chosen;
}

}  // namespace

std::vector<CollisionPair> find_collision_pairs(const ArticulatedModel& model,
                                                const std::vector<ErodedSurface>& whole,
                                                double usual_erosion, const Executor& executor) {
  std::vector<CollisionPair> pairs;
  const auto bodies = static_cast<int>(model.fields.size());
  for (int a = 0; a < bodies; ++a) {
    for (int b = a + 1; b < bodies; ++b) {
      const bool have_fields =
          model.fields[static_cast<std::size_t>(a)] && model.fields[static_cast<std::size_t>(b)];
      if (have_fields) pairs.push_back({a, b, 0.0, 0.0});
    }
  }
  BodyPoses rest;
  forward_kinematics(model.tree, rest_configuration(model.tree), rest);
  std::vector<std::uint8_t> is_drawn(pairs.size());
  executor.for_each(pairs.size(), [&](std::size_t i) {
    const double at_rest = overlap(model, whole, pairs[i], rest);
    pairs[i].rest_overlap = at_rest < kDistanceRounding ? 0.0 : at_rest;
    is_drawn[i] =
        is_drawn_into(model, whole, pairs[i], pairs[i].rest_overlap + 2.0 * usual_erosion);
  });
  std::vector<CollisionPair> kept;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (is_drawn[i] == 0) kept.push_back(pairs[i]);
  }
  return kept;
}

void choose_erosions(const ArticulatedModel& model, double usual,
                     std::vector<CollisionPair>& pairs) {
  for (CollisionPair& pair : pairs) {
    const auto a = static_cast<std::size_t>(pair.a);
    const auto b = static_cast<std::size_t>(pair.b);
    const double largest =
        kThicknessShare * std::min(model.fields[a]->thickness(), model.fields[b]->thickness());
    pair.erosion = chosen_erosion(model, model.tree.bodies[a], model.tree.bodies[b], largest)
                       .value_or(std::min(usual, largest)) +
                   0.5 * pair.rest_overlap;
  }
}

}  // namespace lockbox
