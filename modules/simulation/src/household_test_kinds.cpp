// SPDX-License-Identifier: BSD-3-Clause
// Sizes are those of usual things, in metres; angles in radians.
#include <array>
#include <cmath>
#include <numbers>

#include "household_kinds.hpp"

namespace lockbox::simulation {
namespace {

ObjectDraft draw_vise(RandomDraws& random) {
  const double jaw = random.uniform(0.1, 0.14);
  const double height = random.uniform(0.1, 0.14);
  const double bed = 2.2 * jaw;
  HouseholdDraft vise("vise", {box_part({jaw, bed, 0.03}, {0.0, 0.0, 0.015}),
                               box_part({jaw, 0.035, height - 0.03},
                                        {0.0, 0.3 * bed, 0.03 + 0.5 * (height - 0.03)})});
  const double free = height - 0.032;
  vise.add("jaw", "base", slide({0.0, 0.3 * bed - 0.037, 0.032}, -kY, 0.45 * bed),
           {box_part({jaw, 0.035, free}, {0.0, 0.0, 0.5 * free}),
            cylinder_part(0.012, 0.08, 1, {0.0, -0.055, 0.5 * free})});
  vise.add("bar", "jaw", spin({0.0, -0.105, 0.5 * free}, kY),
           {box_part({0.014, 0.018, random.uniform(0.1, 0.14)}, {0.0, 0.0, 0.0})});
  return std::move(vise).draft();
}

ObjectDraft draw_gripper(RandomDraws& random) {
  const double reach = random.uniform(0.18, 0.25);
  HouseholdDraft arm("gripper", {box_part({0.2, 0.15, 0.03}, {0.02, 0.0, 0.015}),
                                 cylinder_part(0.055, 0.06, 2, {0.0, 0.0, 0.06})});
  arm.add("shoulder", "base", hinge({0.0, 0.0, 0.092}, kZ, -2.0, 2.0),
          {cylinder_part(0.05, 0.05, 2, {0.0, 0.0, 0.025}),
           box_part({0.05, 0.03, 0.1}, {0.0, 0.025, 0.09})});
  arm.add("upper", "shoulder", hinge({0.0, -0.012, 0.11}, kY, -0.3, 1.3),
          {box_part({0.05, 0.035, reach}, {0.0, -0.0, 0.5 * reach - 0.02})});
  arm.add("hand", "upper", hinge({0.0, 0.0, reach}, kY, -0.4, 1.4),
          {box_part({0.05, 0.12, 0.04}, {0.0, 0.0, 0.025})});
  for (const double side : {-1.0, 1.0}) {
    arm.add(side < 0.0 ? "finger_right" : "finger_left", "hand",
            slide({0.0, 0.012 * side, 0.047}, side * kY, 0.04),
            {box_part({0.025, 0.012, 0.07}, {0.0, 0.0, 0.035})});
  }
  return std::move(arm).draft();
}

ObjectDraft draw_printer(RandomDraws& random) {
  const Vector size = random.uniform({0.38, 0.28, 0.12}, {0.48, 0.36, 0.18});
  HouseholdDraft printer(
      "printer",
      {box_part({size.x(), size.y(), size.z() - 0.06}, {0.0, 0.0, 0.06 + 0.5 * (size.z() - 0.06)}),
       box_part({0.04, size.y(), 0.06}, {0.5 * size.x() - 0.02, 0.0, 0.03}),
       box_part({0.04, size.y(), 0.06}, {-0.5 * size.x() + 0.02, 0.0, 0.03}),
       box_part({0.08, 0.015, 0.04}, {-0.3 * size.x(), -0.5 * size.y() - 0.008, 0.1})});
  const double lid = size.y() - 0.02;
  printer.add("lid", "base", hinge({0.0, 0.5 * lid, size.z() + 0.001}, -kX, 0.0, 1.4),
              {box_part({size.x() - 0.02, lid, 0.02}, {0.0, -0.5 * lid, 0.01})});
  printer.add("tray", "base", slide({0.0, -0.5 * size.y(), 0.004}, -kY, 0.2),
              {box_part({size.x() - 0.09, 0.24, 0.012}, {0.0, 0.12, 0.006}),
               box_part({size.x() - 0.09, 0.012, 0.045}, {0.0, 0.006, 0.0225})});
  return std::move(printer).draft();
}

ObjectDraft draw_monitor(RandomDraws& random) {
  const double width = random.uniform(0.42, 0.58);
  const double height = 0.6 * width;
  const double post = random.uniform(0.3, 0.38);
  HouseholdDraft monitor("monitor", {box_part({0.22, 0.18, 0.015}, {0.0, 0.02, 0.0075}),
                                     box_part({0.05, 0.03, post}, {0.0, 0.06, 0.5 * post})});
  monitor.add("lift", "base", slide({0.0, 0.03, 0.55 * height + 0.03}, kZ, post - 0.5 * height),
              {box_part({0.07, 0.028, 0.07}, {0.0, 0.0, 0.0})});
  monitor.add("screen", "lift", hinge({0.0, -0.02, 0.0}, -kX, -0.2, 0.35),
              {box_part({width, 0.025, height}, {0.0, -0.02, 0.0})});
  return std::move(monitor).draft();
}

ObjectDraft draw_camera(RandomDraws& random) {
  const double head = random.uniform(0.1, 0.15);
  const double yoke = random.uniform(0.1, 0.13);
  HouseholdDraft camera("camera", {box_part({0.14, 0.18, 0.04}, {0.0, 0.015, 0.02}),
                                   cylinder_part(0.05, 0.02, 2, {0.0, 0.0, 0.05})});
  camera.add("pan", "base", hinge({0.0, 0.0, 0.062}, kZ, -1.5, 1.5),
             {box_part({yoke + 0.03, 0.06, 0.012}, {0.0, 0.0, 0.006}),
              box_part({0.012, 0.05, 0.09}, {0.5 * yoke + 0.008, 0.0, 0.05}),
              box_part({0.012, 0.05, 0.09}, {-0.5 * yoke - 0.008, 0.0, 0.05})});
  camera.add("tilt", "pan", hinge({0.0, 0.0, 0.075}, kX, -0.6, 0.6),
             {box_part({yoke - 0.004, head, 0.07}, {0.0, 0.0, 0.0}),
              cylinder_part(0.025, 0.05, 1, {0.0, -0.5 * head - 0.025, 0.0})});
  return std::move(camera).draft();
}

ObjectDraft draw_oven(RandomDraws& random) {
  const Vector size = random.uniform({0.4, 0.32, 0.3}, {0.5, 0.4, 0.38});
  constexpr double kPanel = 0.07;
  std::vector<DraftPart> parts = case_open_to_front(size, 0.018);
  parts.push_back(
      box_part({size.x(), 0.03, kPanel}, {0.0, -0.5 * size.y() + 0.015, size.z() - 0.5 * kPanel}));
  HouseholdDraft oven("oven", parts);
  const double door = size.z() - kPanel - 0.004;
  oven.add("door", "base", hinge({0.0, -0.5 * size.y() - 0.022, 0.012}, kX, 0.0, 1.5),
           {box_part({size.x() - 0.004, 0.02, door - 0.012}, {0.0, 0.01, 0.5 * (door - 0.012)}),
            box_part({0.7 * size.x(), 0.02, 0.02}, {0.0, -0.02, door - 0.05})});
  oven.add("rack", "base", slide({0.0, 0.0, 0.4 * door}, -kY, 0.2),
           {box_part({size.x() - 0.05, size.y() - 0.06, 0.01}, {0.0, 0.0, 0.0})});
  for (int i = 0; i < 2; ++i) {
    const Vector place((i - 0.5) * 0.5 * size.x(), -0.5 * size.y(), size.z() - 0.5 * kPanel);
    oven.add("knob_" + std::to_string(i + 1), "base", spin(place, kY),
             {cylinder_part(0.02, 0.02, 1, {0.0, -0.011, 0.0}),
              box_part({0.008, 0.02, 0.04}, {0.0, -0.022, 0.0})});
  }
  return std::move(oven).draft();
}

ObjectDraft draw_suitcase(RandomDraws& random) {
  const Vector size = random.uniform({0.32, 0.1, 0.42}, {0.4, 0.14, 0.5});
  HouseholdDraft suitcase("suitcase", case_open_to_front({size.x(), size.y(), size.z()}, 0.012));
  const double shell = random.uniform(0.05, 0.08);
  suitcase.add(
      "shell", "base", hinge({-0.5 * size.x(), -0.5 * size.y() - 0.002, 0.0}, -kZ, 0.0, 2.2),
      {box_part({size.x(), shell, size.z()}, {0.5 * size.x(), -0.5 * shell, 0.5 * size.z()})});
  suitcase.add("handle", "base", slide({0.0, 0.25 * size.y(), size.z() + 0.002}, kZ, 0.12),
               {box_part({0.16, 0.02, 0.02}, {0.0, 0.0, 0.012}),
                box_part({0.012, 0.012, 0.14}, {0.07, 0.0, -0.07}),
                box_part({0.012, 0.012, 0.14}, {-0.07, 0.0, -0.07})});
  return std::move(suitcase).draft();
}

ObjectDraft draw_fan(RandomDraws& random) {
  const double radius = random.uniform(0.11, 0.15);
  const double height = random.uniform(0.2, 0.26);
  HouseholdDraft fan("fan", {cylinder_part(0.09, 0.02, 2, {0.0, 0.0, 0.01}),
                             box_part({0.04, 0.03, height - 0.02}, {0.0, 0.04, 0.5 * height})});
  fan.add("head", "base", hinge({0.0, 0.04, height + 0.03}, kX, -0.5, 0.5),
          {cylinder_part(0.04, 0.1, 1, {0.0, 0.0, 0.0})});
  std::vector<DraftPart> blades{cylinder_part(0.03, 0.03, 1, {0.0, -0.017, 0.0})};
  for (int i = 0; i < 3; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / 3.0;
    DraftPart blade = box_part({radius, 0.006, 0.07},
                               0.6 * radius * Vector(std::cos(turn), 0.0, -std::sin(turn)));
    blade.centre.y() = -0.02;
    blade.rpy = {0.0, turn, 0.0};
    blades.push_back(blade);
  }
  fan.add("blades", "head", spin({0.0, -0.052, 0.0}, kY), blades);
  return std::move(fan).draft();
}

ObjectDraft draw_press(RandomDraws& random) {
  const double radius = random.uniform(0.04, 0.055);
  const double height = random.uniform(0.16, 0.2);
  HouseholdDraft press("press",
                       {cylinder_part(radius, height, 2, {0.0, 0.0, 0.5 * height}),
                        box_part({0.02, 0.02, 0.6 * height}, {radius + 0.035, 0.0, 0.5 * height}),
                        box_part({0.04, 0.02, 0.015}, {radius + 0.015, 0.0, 0.75 * height}),
                        box_part({0.04, 0.02, 0.015}, {radius + 0.015, 0.0, 0.25 * height})});
  press.add("plunger", "base", slide({0.0, 0.0, height + 0.002}, kZ, 0.6 * height),
            {cylinder_part(0.9 * radius, 0.012, 2, {0.0, 0.0, 0.006}),
             cylinder_part(0.008, 0.03, 2, {0.0, 0.0, 0.02}),
             cylinder_part(0.016, 0.02, 2, {0.0, 0.0, 0.045})});
  return std::move(press).draft();
}

ObjectDraft draw_window(RandomDraws& random) {
  const double width = random.uniform(0.4, 0.55);
  const double height = random.uniform(0.35, 0.5);
  constexpr double kFrame = 0.04;
  std::vector<DraftPart> parts;
  for (const double side : {-0.5, 0.5}) {
    parts.push_back(box_part({kFrame, 0.06, height}, {side * (width - kFrame), 0.0, 0.5 * height}));
    parts.push_back(
        box_part({width, 0.06, kFrame}, {0.0, 0.0, 0.5 * height + side * (height - kFrame)}));
  }
  parts.push_back(box_part({0.03, 0.06, height}, {0.0, 0.0, 0.5 * height}));
  HouseholdDraft window("window", parts);
  const double wing = 0.5 * width - kFrame;
  const double tall = height - kFrame;
  for (const double side : {-1.0, 1.0}) {
    const double free = 0.012 * side;
    window.add(side < 0.0 ? "wing_left" : "wing_right", "base",
               hinge({side * (wing + 0.5 * kFrame), -0.055, 0.5 * height}, side * kZ, 0.0, 1.7),
               {box_part({wing, 0.022, tall}, {-0.5 * side * wing - free, 0.011, 0.0}),
                box_part({0.02, 0.03, 0.09}, {-side * (wing - 0.02), -0.015, 0.0})});
  }
  return std::move(window).draft();
}

ObjectDraft draw_stapler(RandomDraws& random) {
  const double length = random.uniform(0.15, 0.22);
  const double width = random.uniform(0.03, 0.04);
  HouseholdDraft stapler("stapler",
                         {box_part({length, width, 0.014}, {0.0, 0.0, 0.007}),
                          box_part({0.04, width, 0.03}, {-0.5 * length + 0.02, 0.0, 0.02})});
  stapler.add("arm", "base", hinge({-0.5 * length + 0.02, 0.0, 0.037}, -kY, 0.0, 1.3),
              {box_part({length, width - 0.006, 0.022}, {0.5 * length - 0.02, 0.0, 0.013})});
  return std::move(stapler).draft();
}

ObjectDraft draw_stool(RandomDraws& random) {
  const double width = random.uniform(0.3, 0.38);
  const double height = random.uniform(0.28, 0.36);
  HouseholdDraft stool("stool", {box_part({width, 0.2, 0.025}, {0.0, 0.0, height}),
                                 box_part({0.03, 0.03, height - 0.013},
                                          {0.5 * width - 0.015, 0.085, 0.5 * (height - 0.013)}),
                                 box_part({0.03, 0.03, height - 0.013},
                                          {-0.5 * width + 0.015, 0.085, 0.5 * (height - 0.013)})});
  const double step = 0.55 * height;
  stool.add(
      "step", "base", hinge({0.0, -0.08, height - 0.015}, -kX, 0.0, 1.1),
      {box_part({width - 0.08, 0.12, 0.02}, {0.0, -0.06, -step}),
       box_part({0.025, 0.03, height - 0.02}, {0.5 * width - 0.055, 0.0, -0.5 * (height - 0.02)}),
       box_part({0.025, 0.03, height - 0.02},
                {-0.5 * width + 0.055, 0.0, -0.5 * (height - 0.02)})});
  return std::move(stool).draft();
}

constexpr std::array<DrawHousehold, 12> kTestKinds = {
    draw_vise,     draw_gripper, draw_printer, draw_monitor, draw_camera,  draw_oven,
    draw_suitcase, draw_fan,     draw_press,   draw_window,  draw_stapler, draw_stool};

}  // namespace

std::span<const DrawHousehold> test_household() {
  return kTestKinds;
}

}  // namespace lockbox::simulation
