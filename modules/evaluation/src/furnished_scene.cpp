// SPDX-License-Identifier: BSD-3-Clause
// Sizes are those of usual furniture and people, in metres.
#include "furnished_scene.hpp"

#include <algorithm>

#include "lockbox/core/units.hpp"

namespace lockbox::evaluation {
namespace {

/// Places boxes of one piece of furniture, whose foot is at (x, 0, z).
class Piece {
 public:
  Piece(Scene& scene, double x, double z, double turn) : scene_(scene) {
    T_.translation() << x, 0.0, z;
    T_.rotate(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY()));
  }

  void box(const Eigen::Vector3d& size, const Eigen::Vector3d& centre, double turn = 0.0) {
    SceneBox box;
    box.frame = SceneFrame::base;
    box.size = size;
    box.pose = T_ * Eigen::Translation3d(centre);
    box.pose.rotate(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY()));
    scene_.boxes.push_back(box);
  }

  void arm(SceneArm arm, const Eigen::Vector3d& shoulder, const Eigen::Vector3d& wrist) {
    arm.frame = SceneFrame::base;
    arm.elbow = T_.linear() * arm.elbow;
    arm.torso = T_.linear() * arm.torso;
    arm.waypoints.push_back({0.0, T_ * shoulder, T_ * wrist});
    scene_.arms.push_back(arm);
  }

 private:
  Scene& scene_;
  Eigen::Isometry3d T_ = Eigen::Isometry3d::Identity();
};

void draw_table(Piece& piece, RandomDraws& random) {
  const Eigen::Vector3d top = random.uniform({1.0, 0.02, 0.6}, {1.8, 0.04, 0.9});
  const double height = random.uniform(0.70, 0.78);
  piece.box(top, {0.0, height - 0.5 * top.y(), 0.0});
  for (const double x : {-0.5 * top.x() + 0.05, 0.5 * top.x() - 0.05}) {
    for (const double z : {-0.5 * top.z() + 0.05, 0.5 * top.z() - 0.05}) {
      piece.box({0.05, height - top.y(), 0.05}, {x, 0.5 * (height - top.y()), z});
    }
  }
  const int things = static_cast<int>(random.uniform(1.0, 5.0));
  for (int i = 0; i < things; ++i) {
    const Eigen::Vector3d size = random.uniform({0.05, 0.03, 0.05}, {0.45, 0.4, 0.35});
    const double turn = random.uniform(-1.0, 1.0);
    const double x = random.uniform(-0.4, 0.4) * top.x();
    const double z = random.uniform(-0.3, 0.3) * top.z();
    piece.box(size, {x, height + 0.5 * size.y(), z}, turn);
  }
}

/// Books from the left end on, as far as they go.
void draw_books(Piece& piece, double left, double right, double floor, double depth,
                RandomDraws& random) {
  double x = left + random.uniform(0.0, 0.3);
  while (true) {
    const Eigen::Vector3d size = random.uniform({0.02, 0.17, 0.12}, {0.12, 0.29, 0.22});
    if (x + size.x() > right) return;
    piece.box(size, {x + 0.5 * size.x(), floor + 0.5 * size.y(), 0.5 * (depth - size.z()) - 0.04});
    x += size.x() + (random.chance(0.2) ? random.uniform(0.05, 0.2) : 0.0);
  }
}

void draw_shelf(Piece& piece, RandomDraws& random) {
  constexpr double kBoard = 0.02;
  const double width = random.uniform(0.6, 1.2);
  const double depth = random.uniform(0.25, 0.4);
  const int boards = static_cast<int>(random.uniform(3.0, 6.0));
  const double rise = random.uniform(0.32, 0.4);
  const double height = (boards - 1) * rise + kBoard;
  for (const double x : {-0.5 * width, 0.5 * width}) {
    piece.box({kBoard, height, depth}, {x, 0.5 * height, 0.0});
  }
  if (random.chance(0.6)) piece.box({width, height, 0.005}, {0.0, 0.5 * height, -0.5 * depth});
  for (int i = 0; i < boards; ++i) {
    piece.box({width, kBoard, depth}, {0.0, i * rise + 0.5 * kBoard, 0.0});
    if (i + 1 < boards && random.chance(0.7)) {
      draw_books(piece, -0.5 * width + kBoard, 0.5 * width - kBoard, i * rise + kBoard, depth,
                 random);
    }
  }
}

/// Two doors with handles, which stand out.
void draw_cupboard(Piece& piece, RandomDraws& random) {
  const Eigen::Vector3d size = random.uniform({0.5, 0.8, 0.35}, {1.2, 2.0, 0.6});
  piece.box(size, {0.0, 0.5 * size.y(), 0.0});
  const Eigen::Vector3d door(0.5 * size.x() - 0.01, size.y() - 0.1, 0.02);
  for (const double side : {-1.0, 1.0}) {
    const double front = 0.5 * size.z();
    piece.box(door, {0.25 * side * size.x(), 0.5 * size.y(), front + 0.5 * door.z()});
    piece.box({0.015, 0.15, 0.03}, {0.05 * side, 0.55 * size.y(), front + door.z() + 0.015});
  }
}

void draw_person(Piece& piece, RandomDraws& random) {
  const double shoulder = random.uniform(1.3, 1.5);
  const double hip = shoulder - 0.5;
  SceneArm arm;
  for (const double side : {-1.0, 1.0}) {
    arm.torso = side * Eigen::Vector3d(-0.1, 0.0, 0.0) + Eigen::Vector3d(0.0, -0.5, 0.0);
    arm.torso_radius = 0.13;
    arm.elbow = {side, -1.0, 0.0};
    piece.arm(arm, {0.2 * side, shoulder, 0.0},
              {random.uniform(0.0, 0.3) * side, shoulder - random.uniform(0.1, 0.55),
               random.uniform(0.1, 0.5)});
    SceneArm leg;
    leg.upper_arm = leg.forearm = 0.5 * (hip - 0.05);
    leg.hand = 0.08;
    leg.radius = 0.075;
    leg.elbow = Eigen::Vector3d::UnitZ();
    leg.torso = {-0.12 * side, shoulder + 0.25 - hip, 0.0};  // up to the head
    leg.torso_radius = 0.1;
    piece.arm(leg, {0.12 * side, hip, 0.0}, {0.12 * side, 0.05, 0.0});
  }
}

Eigen::Isometry3d draw_camera(RandomDraws& random) {
  const Eigen::Matrix3d facing =
      Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();  // upright, looking along -z
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.translation() << 0.0, random.uniform(0.8, 1.7), 0.0;
  const double yaw = random.uniform(-25.0, 25.0) * kRadians;
  const double pitch = random.uniform(-5.0, 35.0) * kRadians;
  const double roll = random.uniform(-5.0, 5.0) * kRadians;
  T_base_camera.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()) *
                            Eigen::AngleAxisd(-pitch, Eigen::Vector3d::UnitX()) *
                            Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()))
                               .toRotationMatrix() *
                           facing;
  return T_base_camera.inverse();
}

}  // namespace

FurnishedScene draw_furnished_scene(RandomDraws& random) {
  constexpr double kSpacing = 1.0;   // between the middles of neighbours
  constexpr double kNearest = -1.1;  // z of a piece's middle
  FurnishedScene room;
  Scene& scene = room.scene;
  scene.moving = Moving::camera;
  const auto add_plane = [&](const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    scene.planes.push_back({SceneFrame::base, point, normal, {12.0, 12.0}});
  };
  const double wall = random.uniform(1.6, 3.5);
  add_plane(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY());
  add_plane({0.0, 0.0, -wall}, Eigen::Vector3d::UnitZ());
  if (random.chance(0.6)) {
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    add_plane({side * random.uniform(1.2, 2.5), 0.0, 0.0}, -side * Eigen::Vector3d::UnitX());
  }
  const int pieces = static_cast<int>(random.uniform(2.0, 5.0));
  for (int i = 0; i < pieces; ++i) {
    const double x = kSpacing * (i - 0.5 * (pieces - 1)) + random.uniform(-0.15, 0.15);
    const auto kind = static_cast<int>(random.uniform(0.0, 4.0));
    const bool stands_free = kind == 0 || kind == 3;
    const double by_wall = std::min(kNearest, 0.35 - wall);
    const double z = stands_free ? random.uniform(by_wall, kNearest) : by_wall;
    Piece piece(scene, x, z, stands_free ? random.uniform(-0.5, 0.5) : 0.0);
    const auto draw = {draw_table, draw_shelf, draw_cupboard, draw_person};
    const auto names = {"table", "shelf", "cupboard", "person"};
    draw.begin()[kind](piece, random);
    room.content.append(room.content.empty() ? "" : "+").append(names.begin()[kind]);
  }
  room.T_camera_base = draw_camera(random);
  return room;
}

}  // namespace lockbox::evaluation
