// SPDX-License-Identifier: BSD-3-Clause
// Sizes are those of usual things, in metres; angles in radians.
#include <array>
#include <cmath>
#include <numbers>

#include "household_kinds.hpp"

namespace lockbox::simulation {
namespace {

ObjectDraft draw_laptop(RandomDraws& random) {
  const double width = random.uniform(0.28, 0.38);
  const double depth = random.uniform(0.19, 0.26);
  const double base = random.uniform(0.014, 0.022);
  const double lid = random.uniform(0.006, 0.010);
  HouseholdDraft laptop("laptop", {box_part({width, depth, base}, {0.0, 0.0, 0.5 * base})});
  laptop.add("lid", "base", hinge({0.0, 0.5 * depth, base + 0.5 * lid}, -kX, 0.0, 2.2),
             {box_part({width, depth - 0.01, lid}, {0.0, -0.5 * (depth - 0.01), 0.0})});
  return std::move(laptop).draft();
}

ObjectDraft draw_box(RandomDraws& random) {
  const Vector size = random.uniform({0.2, 0.14, 0.08}, {0.35, 0.22, 0.15});
  const double lid = random.uniform(0.012, 0.04);
  HouseholdDraft box("box", case_open_to_top(size, 0.01));
  box.add("lid", "base", hinge({0.0, 0.5 * size.y(), size.z()}, -kX, 0.0, 1.8),
          {box_part({size.x(), size.y(), lid}, {0.0, -0.5 * size.y(), 0.5 * lid})});
  return std::move(box).draft();
}

ObjectDraft draw_rule(RandomDraws& random) {
  const double length = random.uniform(0.14, 0.22);
  const double width = random.uniform(0.025, 0.035);
  const double thickness = random.uniform(0.008, 0.013);
  const auto leaf = [&](double from) {
    return std::vector{
        box_part({length, width, thickness}, {from + 0.5 * length, 0.0, 0.5 * thickness})};
  };
  HouseholdDraft rule("rule", leaf(0.0));
  std::string parent = "base";
  for (int i = 1; i < 5; ++i) {
    const std::string name = "leaf_" + std::to_string(i);
    const double before = i == 1 ? length - 0.01 : length - 0.02;
    rule.add(name, parent, hinge({before, 0.0, thickness + 0.001}, kZ, -2.8, 2.8), leaf(-0.01));
    parent = name;
  }
  return std::move(rule).draft();
}

ObjectDraft draw_lamp(RandomDraws& random) {
  const double lower = random.uniform(0.2, 0.3);
  const double upper = random.uniform(0.18, 0.28);
  const double thickness = random.uniform(0.012, 0.02);
  HouseholdDraft lamp("lamp", {cylinder_part(random.uniform(0.07, 0.1), 0.02, 2, {0.0, 0.0, 0.01}),
                               cylinder_part(0.012, 0.08, 2, {0.0, 0.0, 0.06})});
  lamp.add("lower", "base", hinge({0.0, 0.0, 0.1}, kY, -0.8, 0.8),
           {box_part({thickness, 0.03, lower}, {0.0, 0.0, 0.5 * lower})});
  lamp.add("upper", "lower", hinge({thickness + 0.001, 0.0, lower}, kY, 0.3, 2.2),
           {box_part({thickness, 0.03, upper}, {0.0, 0.0, 0.5 * upper})});
  lamp.add("shade", "upper", hinge({0.0, 0.0, upper}, kY, -0.6, 1.6),
           {cylinder_part(random.uniform(0.04, 0.06), 0.09, 2, {0.0, 0.0, 0.05})});
  return std::move(lamp).draft();
}

ObjectDraft draw_microwave(RandomDraws& random) {
  const Vector size = random.uniform({0.4, 0.28, 0.22}, {0.5, 0.36, 0.29});
  const double panel = random.uniform(0.08, 0.12);
  const double door = size.x() - panel - 0.004;
  std::vector<DraftPart> parts = case_open_to_front(size, 0.02);
  parts.push_back(
      box_part({panel, size.y(), size.z()}, {0.5 * (size.x() - panel), 0.0, 0.5 * size.z()}));
  HouseholdDraft oven("microwave", parts);
  const Vector corner(-0.5 * size.x(), -0.5 * size.y() - 0.02, 0.5 * size.z());
  oven.add("door", "base", hinge(corner, -kZ, 0.0, 1.9),
           {box_part({door, 0.018, size.z() - 0.01}, {0.5 * door, 0.009, 0.0}),
            box_part({0.02, 0.03, 0.7 * size.z()}, {door - 0.03, -0.015, 0.0})});
  return std::move(oven).draft();
}

ObjectDraft draw_chair(RandomDraws& random) {
  const double width = random.uniform(0.34, 0.42);
  const double seat = random.uniform(0.36, 0.44);
  const double back = random.uniform(0.35, 0.45);
  const double leg = 0.5 * width - 0.015;
  std::vector<DraftPart> parts{box_part({width, width, 0.03}, {0.0, 0.0, seat})};
  for (const double side : {-leg, leg}) {
    parts.push_back(box_part({0.03, 0.03, seat}, {side, leg, 0.5 * seat}));
  }
  HouseholdDraft chair("chair", parts);
  chair.add("back", "base", hinge({0.0, 0.5 * width, seat + 0.02}, kX, -0.3, 1.4),
            {box_part({width, 0.03, back}, {0.0, 0.0, 0.5 * back})});
  std::vector<DraftPart> legs{box_part({width - 0.09, 0.02, 0.04}, {0.0, 0.0, -0.6 * seat})};
  for (const double side : {-leg + 0.035, leg - 0.035}) {
    legs.push_back(box_part({0.03, 0.03, seat - 0.02}, {side, 0.0, -0.5 * (seat - 0.02)}));
  }
  chair.add("legs", "base", hinge({0.0, -leg, seat - 0.016}, kX, -0.1, 1.2), legs);
  return std::move(chair).draft();
}

ObjectDraft draw_safe(RandomDraws& random) {
  const Vector size = random.uniform({0.3, 0.26, 0.28}, {0.42, 0.34, 0.38});
  const Vector door = size - Vector(0.034, 0.0, 0.034);
  HouseholdDraft safe("safe", case_open_to_front(size, 0.015));
  safe.add("door", "base", hinge({-0.5 * door.x(), -0.5 * size.y(), 0.5 * size.z()}, -kZ, 0.0, 1.8),
           {box_part({door.x(), 0.03, door.z()}, {0.5 * door.x(), 0.015, 0.0})});
  safe.add("dial", "door", spin({0.5 * door.x(), 0.0, 0.15 * door.z()}, kY),
           {cylinder_part(0.03, 0.03, 1, {0.0, -0.016, 0.0}),
            box_part({0.01, 0.03, 0.05}, {0.0, -0.035, 0.0})});
  safe.add("handle", "door",
           hinge({0.65 * door.x(), 0.0, -0.15 * door.z()}, kY, 0.0, 0.5 * std::numbers::pi),
           {cylinder_part(0.012, 0.03, 1, {0.0, -0.016, 0.0}),
            box_part({0.12, 0.015, 0.02}, {0.05, -0.035, 0.0})});
  return std::move(safe).draft();
}

ObjectDraft draw_levers(RandomDraws& random) {
  const int levers = random.chance(0.5) ? 4 : 3;
  const double pitch = random.uniform(0.1, 0.14);
  const double width = (levers + 0.2) * pitch;
  HouseholdDraft panel("levers", {box_part({width, 0.3, 0.02}, {0.0, 0.0, 0.01})});
  const double length = random.uniform(0.11, 0.16);
  for (int i = 0; i < levers; ++i) {
    const double x = pitch * (i - 0.5 * (levers - 1));
    panel.add("lever_" + std::to_string(i + 1), "base", hinge({x, -0.05, 0.021}, kZ, -0.8, 0.8),
              {box_part({0.03, length, 0.02}, {0.0, 0.5 * length, 0.01}),
               cylinder_part(0.015, 0.04, 2, {0.0, length - 0.01, 0.03})});
  }
  return std::move(panel).draft();
}

ObjectDraft draw_toolbox(RandomDraws& random) {
  const Vector size = random.uniform({0.34, 0.18, 0.15}, {0.45, 0.24, 0.22});
  HouseholdDraft box("toolbox", case_open_to_top(size, 0.01));
  const double lid = 0.5 * size.y() - 0.012;
  for (const double side : {-1.0, 1.0}) {
    box.add(side < 0.0 ? "lid_front" : "lid_back", "base",
            hinge({0.0, 0.5 * side * size.y(), size.z() + 0.001}, -side * kX, 0.0, 1.9),
            {box_part({size.x(), lid, 0.015}, {0.0, -0.5 * side * lid, 0.0075})});
  }
  box.add("bar", "base", hinge({0.0, 0.0, size.z() + 0.012}, kX, -1.2, 1.2),
          {box_part({0.7 * size.x(), 0.02, 0.02}, {0.0, 0.0, 0.1}),
           box_part({0.02, 0.02, 0.09}, {0.34 * size.x(), 0.0, 0.05}),
           box_part({0.02, 0.02, 0.09}, {-0.34 * size.x(), 0.0, 0.05})});
  return std::move(box).draft();
}

ObjectDraft draw_pliers(RandomDraws& random) {
  const double grip = random.uniform(0.1, 0.13);
  const double jaw = random.uniform(0.04, 0.055);
  const double thickness = random.uniform(0.01, 0.014);
  const auto leg = [&](double side, double z) {
    return std::vector{box_part({grip, 0.018, thickness}, {-0.5 * grip - 0.004, 0.012 * side, z}),
                       box_part({jaw, 0.012, thickness}, {0.5 * jaw + 0.006, -0.006 * side, z})};
  };
  std::vector<DraftPart> parts = leg(1.0, 0.5 * thickness);
  parts.push_back(cylinder_part(0.014, thickness, 2, {0.0, 0.0, 0.5 * thickness}));
  HouseholdDraft pliers("pliers", parts);
  pliers.add("leg", "base", hinge({0.0, 0.0, 0.0}, kZ, -0.05, 0.7), leg(-1.0, 0.5 * thickness));
  return std::move(pliers).draft();
}

ObjectDraft draw_arm(RandomDraws& random) {
  const int links = static_cast<int>(random.uniform(3.0, 6.0));
  const double length = random.uniform(0.1, 0.15);
  const double width = random.uniform(0.035, 0.05);
  const double foot = random.uniform(0.04, 0.06);
  HouseholdDraft arm("arm",
                     {box_part({0.16, random.uniform(0.12, 0.2), foot}, {0.0, 0.0, 0.5 * foot})});
  std::string parent = "base";
  Vector origin(0.0, 0.0, foot + 0.002);
  for (int i = 0; i < links; ++i) {
    const std::string name = "link_" + std::to_string(i + 1);
    const auto motion = i == 0 ? hinge(origin, kZ, -2.5, 2.5) : hinge(origin, kY, -1.1, 1.1);
    arm.add(
        name, parent, motion,
        {box_part({width, (i % 2 == 0 ? 0.8 : 0.6) * width, length}, {0.0, 0.0, 0.5 * length})});
    origin = {0.0, i % 2 == 0 ? 0.75 * width : -0.75 * width, length - 0.5 * width};
    parent = name;
  }
  return std::move(arm).draft();
}

ObjectDraft draw_tripod(RandomDraws& random) {
  const double length = random.uniform(0.35, 0.5);
  const double radius = random.uniform(0.01, 0.014);
  const double height = length + 0.03;
  HouseholdDraft tripod("tripod", {cylinder_part(0.03, 0.05, 2, {0.0, 0.0, height}),
                                   box_part({0.07, 0.04, 0.03}, {0.0, 0.01, height + 0.04})});
  for (int i = 0; i < 3; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / 3.0;
    const Vector out(std::cos(turn), std::sin(turn), 0.0);
    tripod.add("leg_" + std::to_string(i + 1), "base",
               hinge(Vector(0.0, 0.0, length) + 0.022 * out, out.cross(kZ), 0.0, 0.7),
               {cylinder_part(radius, length, 2, {0.0, 0.0, -0.5 * length})});
  }
  return std::move(tripod).draft();
}

constexpr std::array<DrawHousehold, 12> kTuningKinds = {
    draw_laptop, draw_box,    draw_rule,    draw_lamp,   draw_microwave, draw_chair,
    draw_safe,   draw_levers, draw_toolbox, draw_pliers, draw_arm,       draw_tripod};

}  // namespace

std::span<const DrawHousehold> tuning_household() {
  return kTuningKinds;
}

}  // namespace lockbox::simulation
