// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/absent_room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "furnished_scene.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/random_scene.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "lockbox/model/model_bounds.hpp"
#include "lockbox/simulation/deviating_model.hpp"
#include "lockbox/simulation/random_draws.hpp"

namespace lockbox {
namespace {

/// How far a box's edges are from the model's at least: what a person would call another box.
constexpr double kOtherSize = 0.15;
constexpr double kLeastGrowth = 0.10;  ///< of near misses
constexpr double kMostGrowth = 0.20;
constexpr int kMostDraws = 500;
/// Tells draws for the same room from each other.
constexpr std::uint64_t kNearMiss = std::uint64_t{1} << 63U;
constexpr std::uint64_t kContents = std::uint64_t{1} << 62U;
constexpr unsigned kDrawBits = 40;

std::size_t pick(std::size_t count, RandomDraws& random) {
  const double drawn = random.uniform(0.0, static_cast<double>(count));
  return std::min(static_cast<std::size_t>(drawn), count - 1);
}

KinematicTree rigid_tree(const std::string& name, TriangleMesh mesh) {
  KinematicTree tree;
  tree.name = name;
  Body& body = tree.bodies.emplace_back();
  body.name = name;
  body.links = {name};
  body.mesh = std::move(mesh);
  return tree;
}

/// A camera in a quiet hand: 5 mm and 0.3 degrees from frame to frame.
std::vector<State> hand_held(const State& first, int frames, RandomDraws& random) {
  constexpr double kRate = 30.0;
  constexpr double kShift = 0.005;
  constexpr double kTurn = 0.3 * kRadians;
  const Eigen::Vector3d shift = kShift * random.direction();
  const Eigen::Vector3d axis = random.direction();
  std::vector<State> run;
  for (int i = 0; i < frames; ++i) {
    State& state = run.emplace_back(first);
    state.stamp = i / kRate;
    state.configuration.T_camera_base = Eigen::Translation3d(i * shift) *
                                        Eigen::AngleAxisd(i * kTurn, axis) *
                                        first.configuration.T_camera_base;
  }
  return run;
}

/// A handle (an empty name) or one of the moving parts.
std::vector<std::string> parts_that_can_be_missing(const KinematicTree& tree) {
  std::vector<std::string> parts;
  if (count_handles(tree) > 0) parts.emplace_back();
  for (std::size_t b = 1; b < tree.bodies.size(); ++b) {
    if (!tree.bodies[b].mesh.triangles.empty()) parts.push_back(tree.bodies[b].name);
  }
  return parts;
}

}  // namespace

std::string to_string(AbsentKind kind) {
  switch (kind) {
    case AbsentKind::furniture:
      return "furniture";
    case AbsentKind::boxes:
      return "boxes";
    case AbsentKind::other_model:
      return "other-model";
    case AbsentKind::missing_part:
      return "missing-part";
    case AbsentKind::larger:
      return "larger";
  }
  return {};
}

const std::vector<AbsentKind>& absent_kinds() {
  static const std::vector<AbsentKind> kinds = {AbsentKind::furniture, AbsentKind::boxes,
                                                AbsentKind::other_model, AbsentKind::missing_part,
                                                AbsentKind::larger};
  return kinds;
}

bool is_near_miss(AbsentKind kind) {
  return kind == AbsentKind::missing_part || kind == AbsentKind::larger;
}

bool differs(const Eigen::Vector3d& size, const Eigen::Vector3d& other, double share) {
  std::array<int, 3> order{0, 1, 2};
  do {
    int different = 0;
    for (int i = 0; i < 3; ++i) {
      const double edge = size[order[static_cast<std::size_t>(i)]];
      different += std::abs(edge - other[i]) >= share * other[i] ? 1 : 0;
    }
    if (different < 2) return false;
  } while (std::next_permutation(order.begin(), order.end()));
  return true;
}

AbsentRooms::AbsentRooms(const ArticulatedModel& model, std::vector<const ArticulatedModel*> others,
                         const PinholeCamera& camera, std::uint64_t seed, const Executor& executor)
    : model_(model),
      others_(std::move(others)),
      camera_(camera),
      seed_(seed),
      executor_(executor),
      parts_(parts_that_can_be_missing(model.tree)) {
  sizes_.push_back(model_bounds(model.tree, rest_configuration(model.tree)).sizes());
  sizes_.push_back(bounds(model.tree.bodies.front().mesh).sizes());
}

bool AbsentRooms::has_lookalike(const Scene& scene) const {
  return std::any_of(scene.boxes.begin(), scene.boxes.end(), [&](const SceneBox& box) {
    return std::any_of(sizes_.begin(), sizes_.end(), [&](const Eigen::Vector3d& size) {
      return !differs(box.size, size, kOtherSize);
    });
  });
}

/// Draws the view and what stands around `room.tree`, until no box there looks like the model.
void AbsentRooms::surround(AbsentRoom& room, const ArticulatedModel& model,
                           std::uint64_t number) const {
  RandomSceneOptions options;
  if (is_near_miss(room.kind)) options.cut_off_share = 0.0;  // what differs is to be seen
  for (std::uint64_t draw = 0; draw < kMostDraws; ++draw) {
    RandomScene drawn =
        draw_random_scene(model, room.tree, camera_, seed_, number | (draw << kDrawBits), options);
    if (has_lookalike(drawn.scene)) continue;
    room.scene = std::move(drawn.scene);
    room.run = {drawn.truth};
    return;
  }
  throw InputError(model_.file.string(), "all boxes look like this model; no room is without it");
}

AbsentRoom AbsentRooms::furnished(std::uint64_t number) const {
  RandomDraws random(seed_, number | kContents);
  for (int draw = 0; draw < kMostDraws; ++draw) {
    auto drawn = evaluation::draw_furnished_scene(random);
    if (has_lookalike(drawn.scene)) continue;
    AbsentRoom room;
    room.kind = AbsentKind::furniture;
    room.content = drawn.content;
    room.tree = rigid_tree("nothing", {});
    room.scene = std::move(drawn.scene);
    room.run.emplace_back();
    room.run.front().configuration = rest_configuration(room.tree);
    room.run.front().configuration.T_camera_base = drawn.T_camera_base;
    return room;
  }
  throw InputError(model_.file.string(), "all furniture looks like this model; no room is without");
}

AbsentRoom AbsentRooms::with_box(std::uint64_t number) const {
  RandomDraws random(seed_, number | kContents);
  Eigen::Vector3d size;
  const auto looks_like_it = [&](const Eigen::Vector3d& own) {
    return !differs(size, own, kOtherSize);
  };
  do {
    for (int i = 0; i < 3; ++i) size[i] = sizes_.front()[i] * random.uniform(0.6, 1.6);
  } while (std::any_of(sizes_.begin(), sizes_.end(), looks_like_it));
  AbsentRoom room;
  room.kind = AbsentKind::boxes;
  room.content = "box";
  room.tree = rigid_tree(room.content, make_box(size));
  surround(room, model_, number);
  return room;
}

AbsentRoom AbsentRooms::with_other_model(std::uint64_t number) const {
  RandomDraws random(seed_, number | kContents);
  const ArticulatedModel& other = *others_[pick(others_.size(), random)];
  AbsentRoom room;
  room.kind = AbsentKind::other_model;
  room.content = other.tree.name;
  room.tree = other.tree;
  surround(room, other, number);
  return room;
}

AbsentKind AbsentRooms::kind_of_room(std::uint64_t number) const {
  const std::uint64_t kinds = others_.empty() ? 2 : 3;
  return absent_kinds()[number % kinds];
}

AbsentKind AbsentRooms::kind_of_near_miss(std::uint64_t number) const {
  return number % 2 == 0 && !parts_.empty() ? AbsentKind::missing_part : AbsentKind::larger;
}

AbsentRoom AbsentRooms::room(std::uint64_t number, int frames) const {
  const AbsentKind kind = kind_of_room(number);
  AbsentRoom room = kind == AbsentKind::furniture ? furnished(number)
                    : kind == AbsentKind::boxes   ? with_box(number)
                                                  : with_other_model(number);
  RandomDraws random(seed_, number | kContents | kNearMiss);
  room.run = hand_held(room.run.front(), frames, random);
  return room;
}

AbsentRoom AbsentRooms::near_miss(std::uint64_t number, int frames) const {
  RandomDraws random(seed_, number | kNearMiss);
  ObjectDeviation deviation;
  AbsentRoom room;
  room.kind = kind_of_near_miss(number);
  if (room.kind == AbsentKind::missing_part) {
    const std::string& part = parts_[pick(parts_.size(), random)];
    room.content = part.empty() ? "handle" : part;
    deviation.missing_handles = part.empty() ? 1 : 0;
    if (!part.empty()) deviation.missing_parts = {part};
  } else {
    deviation.scale = 1.0 + random.uniform(kLeastGrowth, kMostGrowth);
    room.content = std::to_string(std::lround(100.0 * (deviation.scale - 1.0))) + "%";
  }
  room.tree = deviating_model(model_.tree, deviation, seed_ + number, executor_);
  surround(room, model_, number | kNearMiss);
  room.run = hand_held(room.run.front(), frames, random);
  return room;
}

}  // namespace lockbox
