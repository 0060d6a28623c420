// SPDX-License-Identifier: BSD-3-Clause
// Sizes are those of usual things, in metres.
#include <array>
#include <cmath>
#include <numbers>

#include "free_form_kinds.hpp"
#include "swept_shapes.hpp"

namespace lockbox::evaluation {
namespace {

FreeFormObject draw_bottle(RandomDraws& random) {
  const double radius = random.uniform(0.032, 0.045);
  const double height = random.uniform(0.22, 0.30);
  const double neck = random.uniform(0.012, 0.016);
  const double shoulder = random.uniform(0.55, 0.70) * height;
  const std::array<Eigen::Vector2d, 9> profile{{{0.85 * radius, 0.0},
                                                {radius, 0.1 * radius},
                                                {radius, shoulder},
                                                {0.92 * radius, shoulder + 0.08 * height},
                                                {0.5 * (radius + neck), shoulder + 0.15 * height},
                                                {neck, shoulder + 0.22 * height},
                                                {neck, 0.95 * height},
                                                {1.15 * neck, 0.96 * height},
                                                {1.15 * neck, height}}};
  return {"bottle", {{"bottle", revolved(profile)}}, {}};
}

/// Draws a can with a dent that its rings are fine enough to show.
FreeFormObject draw_can(RandomDraws& random) {
  const double radius = random.uniform(0.033, 0.043);
  const double height = random.uniform(0.11, 0.17);
  std::vector<Eigen::Vector2d> profile{{0.9 * radius, 0.0}};
  constexpr int kRings = 24;
  for (int i = 0; i <= kRings; ++i) {
    profile.emplace_back(radius, 0.1 * radius + (height - 0.2 * radius) * i / kRings);
  }
  profile.emplace_back(0.9 * radius, height);
  TriangleMesh mesh = revolved(profile);
  const Eigen::Vector3d dent(radius, 0.0, random.uniform(0.4, 0.65) * height);
  const double width = random.uniform(0.5, 0.7) * radius;
  const double depth = random.uniform(0.35, 0.5) * radius;
  for (Eigen::Vector3d& p : mesh.vertices) {
    p.x() -= depth * std::exp(-0.5 * (p - dent).squaredNorm() / (width * width));
  }
  return {"can", {{"can", mesh}}, {}};
}

FreeFormObject draw_tap(RandomDraws& random) {
  const double radius = random.uniform(0.011, 0.016);
  const double height = random.uniform(0.12, 0.20);
  const double reach = random.uniform(0.05, 0.075);
  const std::array<Eigen::Vector2d, 5> foot{{{2.2 * radius, 0.0},
                                             {2.2 * radius, 0.4 * radius},
                                             {1.5 * radius, 1.0 * radius},
                                             {1.4 * radius, 3.5 * radius},
                                             {0.9 * radius, 4.0 * radius}}};
  TriangleMesh mesh = revolved(foot);
  std::vector<Eigen::Vector3d> way{{0.0, 0.0, 2.0 * radius}};
  const Eigen::Vector3d centre(reach, 0.0, height);
  const auto curve = arc(centre, centre - reach * Eigen::Vector3d::UnitX(),
                         Eigen::Vector3d::UnitY(), std::numbers::pi);
  way.insert(way.end(), curve.begin(), curve.end());
  way.emplace_back(way.back() - 0.3 * reach * Eigen::Vector3d::UnitZ());
  append(mesh, tube(way, radius));
  const double lever = random.uniform(0.05, 0.07);
  append(mesh, tube({{0.0, 0.0, 3.0 * radius}, {0.0, lever, 4.5 * radius}}, 0.6 * radius));
  return {"tap", {{"tap", mesh}}, {}};
}

FreeFormObject draw_drill(RandomDraws& random) {
  const double length = random.uniform(0.15, 0.20);
  const double radius = random.uniform(0.028, 0.034);
  const double grip = random.uniform(0.11, 0.14);
  const double foot = 0.028;
  TriangleMesh mesh = ellipsoid({0.0, 0.0, 0.5 * foot}, {0.055, 0.035, 0.5 * foot});
  const double top = grip + foot;
  append(mesh, tube({{-0.005, 0.0, 0.5 * foot}, {-0.03, 0.0, top}}, 0.55 * radius));
  append(mesh, tube({{-0.5 * length, 0.0, top}, {0.3 * length, 0.0, top}}, radius));
  append(mesh, tube({{0.3 * length, 0.0, top}, {0.65 * length, 0.0, top}}, 0.6 * radius));
  append(mesh, tube({{0.65 * length, 0.0, top}, {length, 0.0, top}}, 0.008));
  return {"drill", {{"drill", mesh}}, {}};
}

/// A left hand, its fingers up and somewhat spread and bent.
FreeFormObject draw_hand(RandomDraws& random) {
  const double width = random.uniform(0.040, 0.048);
  const double palm = random.uniform(0.048, 0.056);
  const double thick = 0.017;
  TriangleMesh mesh = tube({{0.0, 0.0, 0.03}, {0.0, 0.0, 0.08}}, 0.028);
  const double middle = 0.08 + palm;
  append(mesh, ellipsoid({0.0, 0.0, middle}, {thick, width, palm}));
  constexpr std::array kLengths{0.055, 0.070, 0.076, 0.068};  // from the little finger on
  for (std::size_t i = 0; i < kLengths.size(); ++i) {
    const double share = (static_cast<double>(i) - 1.5) / 1.5;
    const double length = kLengths[i] * random.uniform(0.9, 1.1);
    const Eigen::Vector3d root(0.0, 0.75 * share * width,
                               middle + (0.85 - 0.2 * share * share) * palm);
    const Eigen::Vector3d way(random.uniform(0.0, 0.3), 0.22 * share, 1.0);
    const Eigen::Vector3d bent(random.uniform(0.3, 0.8), 0.2 * share, 1.0);
    const Eigen::Vector3d knuckle = root + 0.55 * length * way.normalized();
    append(mesh, tube({root, knuckle, knuckle + 0.45 * length * bent.normalized()}, 0.0095));
  }
  const Eigen::Vector3d root(0.0, 0.6 * width, middle - 0.4 * palm);
  append(mesh, tube({root, root + Eigen::Vector3d(0.015, 0.04, 0.025),
                     root + Eigen::Vector3d(0.02, 0.05, 0.06)},
                    0.011));
  return {"hand", {{"hand", mesh}}, {}};
}

/// A foot with a rod, an arm, and a shade at its end.
FreeFormObject draw_lamp(RandomDraws& random) {
  const double rod = random.uniform(0.14, 0.20);
  const double arm = random.uniform(0.13, 0.18);
  const double radius = random.uniform(0.055, 0.075);
  const double thick = 0.009;
  const std::array<Eigen::Vector2d, 4> plate{
      {{radius, 0.0}, {radius, 0.012}, {0.6 * radius, 0.024}, {0.3 * radius, 0.03}}};
  TriangleMesh foot = revolved(plate);
  append(foot, tube({{0.0, 0.0, 0.02}, {0.0, 0.0, rod}}, thick));
  const double shade = random.uniform(0.045, 0.06);
  const std::array<Eigen::Vector2d, 4> cone{{{shade, -0.05 - shade},
                                             {0.8 * shade, -0.03 - 0.3 * shade},
                                             {0.4 * shade, -0.012},
                                             {0.3 * shade, 0.0}}};
  const double beside = 2.4 * thick;
  const TriangleMesh bar = tube({{0.0, beside, 0.0}, {arm, beside, 0.0}}, thick);
  const Eigen::Vector3d axis = -Eigen::Vector3d::UnitY();
  return {"lamp",
          {{"foot", foot}, {"arm", bar}, {"shade", revolved(cone)}},
          {{{0.0, 0.0, rod}, axis, -0.2, 1.2}, {{arm, 0.0, -0.012}, axis, -0.8, 0.8}}};
}

constexpr std::array<DrawFreeForm, 6> kTestKinds{draw_bottle, draw_can,  draw_tap,
                                                 draw_drill,  draw_hand, draw_lamp};

}  // namespace

std::span<const DrawFreeForm> test_kinds() {
  return kTestKinds;
}

}  // namespace lockbox::evaluation
