// SPDX-License-Identifier: BSD-3-Clause
// Sizes are those of usual things, in metres.
#include <array>
#include <numbers>

#include "free_form_kinds.hpp"
#include "swept_shapes.hpp"

namespace lockbox::evaluation {
namespace {

FreeFormObject draw_mug(RandomDraws& random) {
  const double radius = random.uniform(0.036, 0.046);
  const double height = random.uniform(0.085, 0.115);
  const double wall = 0.005;
  const std::array<Eigen::Vector2d, 8> profile{{{0.8 * radius, 0.0},
                                                {radius, 0.1 * radius},
                                                {radius, height - 0.5 * wall},
                                                {radius - 0.25 * wall, height},
                                                {radius - 0.75 * wall, height},
                                                {radius - wall, height - 0.5 * wall},
                                                {radius - wall, 2.0 * wall},
                                                {0.8 * radius - wall, wall}}};
  TriangleMesh mesh = revolved(profile);
  const double middle = 0.52 * height;
  const double reach = random.uniform(0.24, 0.32) * height;
  const Eigen::Vector3d centre(radius - 0.5 * wall, 0.0, middle);
  append(mesh, tube(arc(centre, centre - reach * Eigen::Vector3d::UnitZ(),
                        -Eigen::Vector3d::UnitY(), std::numbers::pi),
                    random.uniform(0.005, 0.007)));
  return {"mug", {{"mug", mesh}}, {}};
}

FreeFormObject draw_animal(RandomDraws& random) {
  const double length = random.uniform(0.10, 0.16);
  const double girth = random.uniform(0.22, 0.30) * length;
  const double leg = random.uniform(0.30, 0.45) * length;
  const double height = leg + 0.8 * girth;
  TriangleMesh mesh = ellipsoid({0.0, 0.0, height}, {0.5 * length, girth, girth});
  const double head = random.uniform(0.18, 0.24) * length;
  const Eigen::Vector3d face(0.55 * length, 0.0, height + 0.9 * girth);
  append(mesh, ellipsoid(face, {1.1 * head, 0.9 * head, head}));
  append(mesh, tube({face, face + Eigen::Vector3d(1.5 * head, 0.0, -0.3 * head)}, 0.45 * head));
  const double thick = 0.07 * length;
  for (const double side : {-1.0, 1.0}) {
    append(mesh, tube({face + Eigen::Vector3d(-0.3 * head, 0.7 * side * head, 0.5 * head),
                       face + Eigen::Vector3d(-0.5 * head, 1.0 * side * head, 1.3 * head)},
                      0.28 * head));
    for (const double end : {-0.32, 0.32}) {
      append(mesh, tube({{end * length, 0.55 * side * girth, height},
                         {end * length, 0.65 * side * girth, thick}},
                        thick));
    }
  }
  const Eigen::Vector3d rump(-0.47 * length, 0.0, height + 0.3 * girth);
  append(mesh,
         tube({rump, rump + Eigen::Vector3d(-0.2 * length, 0.0, 0.2 * length)}, 0.045 * length));
  return {"animal", {{"animal", mesh}}, {}};
}

FreeFormObject draw_elbow(RandomDraws& random) {
  const double radius = random.uniform(0.018, 0.026);
  const double bend = random.uniform(1.8, 2.6) * radius;
  const double straight = random.uniform(1.0, 2.5) * radius;
  const double collar = 1.25 * radius;
  const Eigen::Vector3d centre(bend, 0.0, straight + collar);
  std::vector<Eigen::Vector3d> way{{0.0, 0.0, collar}};
  const auto curve = arc(centre, centre - bend * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                         0.5 * std::numbers::pi);
  way.insert(way.end(), curve.begin(), curve.end());
  way.emplace_back(way.back() + 2.0 * straight * Eigen::Vector3d::UnitX());
  TriangleMesh mesh = tube(way, radius);
  append(mesh, tube({{0.0, 0.0, collar}, {0.0, 0.0, 1.6 * collar}}, collar));
  const Eigen::Vector3d end = way.back();
  append(mesh, tube({end - 0.6 * collar * Eigen::Vector3d::UnitX(), end}, collar));
  return {"elbow", {{"elbow", mesh}}, {}};
}

/// One leg of a pair of pliers, handle and jaw, that crosses the hinge at the origin.
TriangleMesh plier_leg(double side, double handle, double jaw, double radius) {
  const double over = 0.55 * side * radius;
  TriangleMesh leg = tube({{-handle, 0.35 * side * handle, over},
                           {-0.5 * handle, 0.26 * side * handle, over},
                           {0.0, 0.0, over},
                           {0.35 * jaw, -0.25 * side * jaw, 0.0},
                           {jaw, -0.08 * side * jaw, 0.0}},
                          radius);
  append(leg, ellipsoid({0.0, 0.0, over}, {2.0 * radius, 2.0 * radius, radius}));
  return leg;
}

FreeFormObject draw_pliers(RandomDraws& random) {
  const double handle = random.uniform(0.11, 0.15);
  const double jaw = random.uniform(0.045, 0.07);
  const double radius = random.uniform(0.008, 0.010);
  FreeFormObject pliers{"pliers",
                        {{"leg", plier_leg(1.0, handle, jaw, radius)},
                         {"other_leg", plier_leg(-1.0, handle, jaw, radius)}},
                        {{{0.0, 0.0, 0.0}, -Eigen::Vector3d::UnitZ(), -0.15, 0.6}}};
  return pliers;
}

constexpr std::array<DrawFreeForm, 4> kTuningKinds{draw_mug, draw_animal, draw_elbow, draw_pliers};

}  // namespace

std::span<const DrawFreeForm> tuning_kinds() {
  return kTuningKinds;
}

}  // namespace lockbox::evaluation
