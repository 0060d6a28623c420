// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/absent_room.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "initialization/seen_model.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "lockbox/model/model_bounds.hpp"
#include "lockbox/simulation/placed_scene.hpp"

namespace lockbox {
namespace {

const PinholeCamera kRoomCamera{640, 480, 575.8, 575.8, 319.5, 239.5};
const Eigen::Vector3d kBoxSize(0.4, 0.3, 0.1);

Eigen::Vector3d size_at_rest(const KinematicTree& tree) {
  return model_bounds(tree, rest_configuration(tree)).sizes();
}

/// A body without joints and without a distance field, which nobody asks for.
ArticulatedModel one_body(const TriangleMesh& mesh) {
  ArticulatedModel model;
  model.tree.name = "body";
  Body& body = model.tree.bodies.emplace_back();
  body.name = "body";
  body.mesh = mesh;
  return model;
}

/// A small box among rooms in which a larger one may stand as the other object.
class RoomsWithoutABox : public testing::Test {
 protected:
  const ArticulatedModel model_ = one_body(make_box(kBoxSize));
  const ArticulatedModel other_ = one_body(make_cylinder(0.2, 0.5));
  const AbsentRooms rooms_{model_, {&other_}, kRoomCamera, 3, Executor(1)};
};

TEST(Differs, TakesTwoEdgesHoweverTheBoxIsTurned) {
  EXPECT_TRUE(differs({0.15, 0.3, 0.5}, {0.1, 0.2, 0.5}, 0.15));
  EXPECT_FALSE(differs({0.1, 0.2, 0.9}, {0.1, 0.2, 0.5}, 0.15));
  EXPECT_FALSE(differs({0.5, 0.1, 0.3}, {0.1, 0.2, 0.5}, 0.15));
  EXPECT_TRUE(differs({0.115, 0.235, 0.5}, {0.1, 0.2, 0.5}, 0.149));
  EXPECT_FALSE(differs({0.114, 0.235, 0.5}, {0.1, 0.2, 0.5}, 0.15));
}

TEST_F(RoomsWithoutABox, FollowFromSeedAndNumber) {
  const auto pose = [](const AbsentRoom& room) {
    return room.run.back().configuration.T_camera_base.matrix();
  };
  const AbsentRooms others(model_, {&other_}, kRoomCamera, 4, Executor(1));
  for (std::uint64_t number = 0; number < 3; ++number) {
    const AbsentRoom room = rooms_.room(number, 2);
    const AbsentRoom again = rooms_.room(number, 2);
    EXPECT_EQ(pose(room), pose(again));
    ASSERT_EQ(room.scene.boxes.size(), again.scene.boxes.size());
    EXPECT_EQ(room.kind, rooms_.kind_of_room(number));
    EXPECT_NE(pose(room), pose(others.room(number, 2)));
    EXPECT_NE(pose(room), pose(rooms_.room(number + 3, 2)));
  }
}

TEST_F(RoomsWithoutABox, HoldNoBoxOfItsSize) {
  for (std::uint64_t number = 0; number < 18; ++number) {
    const AbsentRoom room = rooms_.room(number, 1);
    for (const SceneBox& box : room.scene.boxes) {
      EXPECT_TRUE(differs(box.size, kBoxSize, 0.15)) << box.size.transpose();
    }
    if (room.kind == AbsentKind::boxes) {
      EXPECT_TRUE(differs(size_at_rest(room.tree), kBoxSize, 0.15));
    } else {
      const bool is_furniture = room.kind == AbsentKind::furniture;
      EXPECT_EQ(room.tree.bodies.front().mesh.triangles.empty(), is_furniture);
      EXPECT_FALSE(room.content.empty());
    }
  }
}

TEST_F(RoomsWithoutABox, AreSeenByAHandHeldCamera) {
  const AbsentRoom room = rooms_.room(1, 3);
  ASSERT_EQ(room.run.size(), 3U);
  for (std::size_t i = 1; i < room.run.size(); ++i) {
    const Eigen::Isometry3d step = room.run[i].configuration.T_camera_base *
                                   room.run[i - 1].configuration.T_camera_base.inverse();
    EXPECT_GT(room.run[i].stamp, room.run[i - 1].stamp);
    EXPECT_NEAR(Eigen::AngleAxisd(step.linear()).angle() * kDegrees, 0.3, 1e-6);
    EXPECT_LT(step.translation().norm(), 0.02);
  }
}

/// Nothing so near that it hides the room, and no view of bare walls alone.
TEST_F(RoomsWithoutABox, ShowFurniture) {
  const PinholeCamera coarse = reduced(kRoomCamera, 8);
  DepthRenderer renderer(coarse, Executor(1));
  for (std::uint64_t number = 0; number < 60; number += 3) {
    const AbsentRoom room = rooms_.room(number, 1);
    Scene without_walls = room.scene;
    without_walls.planes.clear();
    std::vector<RenderItem> items;
    const PlacedScene placed(without_walls, room.run);
    placed.append_items(room.run.front(), items);
    RenderedDepth image;
    renderer.render(items, image);
    const auto seen =
        std::count_if(image.id.begin(), image.id.end(), [](auto id) { return id != kNothing; });
    EXPECT_GT(seen, 100) << number << ": " << room.content;
    EXPECT_GT(*std::min_element(image.depth.begin(), image.depth.end()), 0.3F) << number;
  }
}

TEST_F(RoomsWithoutABox, NearMissesOfARigidModelAreLarger) {
  for (std::uint64_t number = 0; number < 4; ++number) {
    const AbsentRoom room = rooms_.near_miss(number, 1);
    EXPECT_EQ(room.kind, AbsentKind::larger);
    const Eigen::Vector3d growth = size_at_rest(room.tree).cwiseQuotient(kBoxSize);
    EXPECT_GE(growth.minCoeff(), 1.1 - 1e-9);
    EXPECT_LE(growth.maxCoeff(), 1.2 + 1e-9);
  }
}

TEST(NearMisses, LackAPartOrAreLarger) {
  const ArticulatedModel& pair = shipped("carton_pair");
  const AbsentRooms rooms(pair, {}, kRoomCamera, 1, Executor(1));
  const AbsentRoom without_part = rooms.near_miss(0, 1);
  EXPECT_EQ(without_part.kind, AbsentKind::missing_part);
  EXPECT_EQ(without_part.content, "right");
  EXPECT_TRUE(without_part.tree.bodies[1].mesh.triangles.empty());
  EXPECT_EQ(rooms.near_miss(1, 1).kind, AbsentKind::larger);
  EXPECT_TRUE(is_near_miss(AbsentKind::missing_part));
  EXPECT_FALSE(is_near_miss(rooms.kind_of_room(1)));
}

}  // namespace
}  // namespace lockbox
