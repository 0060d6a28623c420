// SPDX-License-Identifier: BSD-3-Clause
#include "mechanisms.hpp"

#include <algorithm>
#include <array>

#include "lockbox/core/units.hpp"

namespace lockbox::simulation {
namespace {

/// Something to grip that stands on z = bottom.
DraftPart grip(bool is_round, double width, double height, const Eigen::Vector2d& place,
               double bottom) {
  const Eigen::Vector3d centre(place.x(), place.y(), bottom + 0.5 * height);
  if (is_round) return cylinder_part(0.5 * width, height, 2, centre);
  return box_part({width, width, height}, centre);
}

/// Sizes and places that were thought of for motion along x, along y instead.
struct Direction {
  bool is_across;

  Eigen::Vector3d turned(double along, double across, double up) const {
    return is_across ? Eigen::Vector3d(across, along, up) : Eigen::Vector3d(along, across, up);
  }
};

/// A block between two rails.
Mechanism draw_slider(double cell, bool has_round_grips, RandomDraws& random) {
  const Direction to{random.chance(0.5)};
  const double length = random.uniform(0.25, 0.4) * cell;
  const double width = random.uniform(0.2, 0.35) * cell;
  const double height = random.uniform(0.018, 0.045);
  const double way = random.uniform(0.75, 0.95) * cell;
  const double rail = random.uniform(0.010, 0.018);
  const double rail_height = random.uniform(0.4, 0.9) * height;
  Mechanism slider{MechanismKind::slider, {}, {}, {}};
  for (const double side : {-0.5, 0.5}) {
    slider.fixed.push_back(box_part(to.turned(way, rail, rail_height),
                                    to.turned(0.0, side * (width + rail), 0.5 * rail_height)));
  }
  slider.moving.push_back(box_part(to.turned(length, width, height), {0.0, 0.0, 0.5 * height}));
  if (random.chance(0.5)) {
    const double reach = random.uniform(0.012, 0.03);
    slider.moving.push_back(
        grip(has_round_grips, random.uniform(0.018, 0.03), reach, {0.0, 0.0}, height));
  }
  const double travel = way - length;
  slider.joint.type = JointType::prismatic;
  slider.joint.origin = to.turned(-0.5 * travel, 0.0, 0.0);
  slider.joint.axis = to.turned(1.0, 0.0, 0.0);
  slider.joint.upper = travel;
  return slider;
}

/// A round bar through two staples, with a grip between them.
Mechanism draw_bolt(double cell, bool has_round_grips, RandomDraws& random) {
  const Direction to{random.chance(0.5)};
  const double radius = random.uniform(0.007, 0.014);
  const double length = random.uniform(0.6, 0.7) * cell;
  const double apart = random.uniform(0.4, 0.48) * cell;  // middles of the staples
  const double grip_width = 1.5 * radius;
  const double staple = 0.016;
  const double cheek = 0.010;
  Mechanism bolt{MechanismKind::bolt, {}, {}, {}};
  for (const double end : {-0.5, 0.5}) {
    for (const double side : {-1.0, 1.0}) {
      bolt.fixed.push_back(box_part(to.turned(staple, cheek, 2.0 * radius),
                                    to.turned(end * apart, side * (radius + 0.5 * cheek), radius)));
    }
    bolt.fixed.push_back(box_part(to.turned(staple, 2.0 * (radius + cheek), cheek),
                                  to.turned(end * apart, 0.0, 2.0 * radius + 0.5 * cheek)));
  }
  bolt.moving.push_back(cylinder_part(radius, length, to.is_across ? 1 : 0, {0.0, 0.0, radius}));
  bolt.moving.push_back(
      grip(has_round_grips, grip_width, radius + random.uniform(0.015, 0.03), {0.0, 0.0}, radius));
  // It stays in both staples, and within its cell.
  const double travel = std::min(apart - staple - grip_width - 0.004, length - apart);
  bolt.joint.type = JointType::prismatic;
  bolt.joint.origin = to.turned(-0.5 * travel, 0.0, 0.0);
  bolt.joint.axis = to.turned(1.0, 0.0, 0.0);
  bolt.joint.upper = travel;
  return bolt;
}

/// Draws a disk with a grip off its middle, or a bar across it that reaches farther to one side.
Mechanism draw_disk(double cell, bool has_round_grips, RandomDraws& random) {
  constexpr double kMostTurn = 150.0 * kRadians;
  const double radius = random.uniform(0.28, 0.45) * cell;
  const double height = random.uniform(0.008, 0.02);
  Mechanism disk{MechanismKind::disk, {}, {}, {}};
  disk.moving.push_back(cylinder_part(radius, height, 2, {0.0, 0.0, 0.5 * height}));
  if (random.chance(0.5)) {
    const double reach = random.uniform(0.015, 0.035);
    disk.moving.push_back(
        grip(has_round_grips, random.uniform(0.02, 0.035), reach, {0.65 * radius, 0.0}, height));
  } else {
    const double bar = random.uniform(0.015, 0.03);
    disk.moving.push_back(box_part({1.1 * radius, random.uniform(0.012, 0.02), bar},
                                   {0.3 * radius, 0.0, height + 0.5 * bar}));
  }
  const bool turns_on = random.chance(0.5);
  disk.joint.type = turns_on ? JointType::continuous : JointType::revolute;
  disk.joint.lower = -kMostTurn;
  disk.joint.upper = kMostTurn;
  return disk;
}

/// Flat on the board, hinged at an edge of its face.
Mechanism draw_door(double cell, bool has_round_grips, RandomDraws& random) {
  const double across = random.uniform(0.6, 0.95) * cell;  // from the hinge
  const double along = random.uniform(0.6, 0.95) * cell;
  const double thickness = random.uniform(0.010, 0.020);
  Mechanism door{MechanismKind::door, {}, {}, {}};
  // As if hinged on the left, then turned by quarters.
  const int quarters = draw_number(random, 0, 3);
  const double c = std::array{1.0, 0.0, -1.0, 0.0}[static_cast<std::size_t>(quarters)];
  const double s = std::array{0.0, 1.0, 0.0, -1.0}[static_cast<std::size_t>(quarters)];
  const auto turned = [&](double x, double y, double z) {
    return Eigen::Vector3d(c * x - s * y, s * x + c * y, z);
  };
  door.moving.push_back(box_part(turned(across, along, thickness).cwiseAbs(),
                                 turned(0.5 * across, 0.0, -0.5 * thickness)));
  const Eigen::Vector3d place = turned(across - 0.025, 0.0, 0.0);
  const double reach = random.uniform(0.014, 0.03);
  door.moving.push_back(
      grip(has_round_grips, random.uniform(0.014, 0.026), reach, place.head<2>(), 0.0));
  door.joint.type = JointType::revolute;
  door.joint.origin = turned(-0.5 * across, 0.0, thickness);
  door.joint.axis = turned(0.0, -1.0, 0.0);
  door.joint.upper = random.uniform(90.0, 120.0) * kRadians;
  return door;
}

}  // namespace

Mechanism draw_mechanism(MechanismKind kind, double cell, bool has_round_grips,
                         RandomDraws& random) {
  switch (kind) {
    case MechanismKind::slider:
      return draw_slider(cell, has_round_grips, random);
    case MechanismKind::bolt:
      return draw_bolt(cell, has_round_grips, random);
    case MechanismKind::disk:
      return draw_disk(cell, has_round_grips, random);
    case MechanismKind::door:
      return draw_door(cell, has_round_grips, random);
  }
  return {};
}

}  // namespace lockbox::simulation
