// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "written_file.hpp"

namespace lockbox {
namespace {

class SceneFile : public WrittenFile {
 protected:
  std::string complaint(const std::string& text) const { return complaint_of(read_scene, text); }
};

TEST_F(SceneFile, EverythingThatItSaysIsRead) {
  const Scene scene = read_scene(write(R"(
moving: camera
room: {lower: [-1, -2, -3], upper: [4, 5, 6]}
planes:
  - {frame: base, point: [1, 2, 3], normal: [0, 0, 2], extent: [4, 5]}
boxes:
  - {size: [0.1, 0.2, 0.3], position: [1, 0, 2], quaternion: [0, 0, 1, 0]}
arms:
  - radius: 0.04
    frame: world
    elbow: [1, 0, 0]
    waypoints:
      - {time: 0.25, shoulder: [0, 0, 1], wrist: [0.1, 0, 1]}
      - {time: 0.75, shoulder: [0, 0, 1], wrist: [0.4, 0, 1]}
)"));
  EXPECT_EQ(scene.moving, Moving::camera);
  ASSERT_TRUE(scene.room);
  EXPECT_EQ(scene.room->min(), Eigen::Vector3d(-1, -2, -3));
  EXPECT_EQ(scene.room->max(), Eigen::Vector3d(4, 5, 6));
  ASSERT_EQ(scene.planes.size(), 1U);
  EXPECT_EQ(scene.planes[0].frame, SceneFrame::base);
  EXPECT_EQ(scene.planes[0].point, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(scene.planes[0].normal, Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(scene.planes[0].extent, Eigen::Vector2d(4, 5));
  ASSERT_EQ(scene.boxes.size(), 1U);
  EXPECT_EQ(scene.boxes[0].frame, SceneFrame::world);
  EXPECT_EQ(scene.boxes[0].size, Eigen::Vector3d(0.1, 0.2, 0.3));
  // Half a turn about z.
  EXPECT_TRUE((scene.boxes[0].pose * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0, 0, 2)));
  ASSERT_EQ(scene.arms.size(), 1U);
  EXPECT_EQ(scene.arms[0].frame, SceneFrame::world);
  EXPECT_EQ(scene.arms[0].radius, 0.04);
  ASSERT_EQ(scene.arms[0].waypoints.size(), 2U);
  EXPECT_EQ(scene.arms[0].waypoints[1].wrist, Eigen::Vector3d(0.4, 0, 1));
}

TEST_F(SceneFile, ShippedScenesAreValid) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(LOCKBOX_SHARE_DIRECTORY "/scenes")) {
    EXPECT_FALSE(read_scene(entry.path()).planes.empty()) << entry.path();
    ++scenes;
  }
  EXPECT_GE(scenes, 3);
}

TEST_F(SceneFile, MissingFileIsNamed) {
  try {
    read_scene("no/such/scene.yaml");
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("no/such/scene.yaml"));
  }
}

TEST_F(SceneFile, MistakesAreNamedWithTheirLine) {
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  EXPECT_THAT(complaint(""), HasSubstr(".yaml:1: "));
  EXPECT_THAT(complaint("- 1\n- 2\n"), HasSubstr("map"));
  EXPECT_THAT(complaint("planes: [\n"), HasSubstr("YAML"));
  EXPECT_THAT(complaint("moving: object\nplane: []\n"),
              AllOf(HasSubstr(".yaml:2: "), HasSubstr("'plane'"), HasSubstr("planes")));
  EXPECT_THAT(complaint("moving: table\n"),
              AllOf(HasSubstr(":1: "), HasSubstr("object or camera")));
  EXPECT_THAT(complaint("moving: object\nroom: {lower: [0, 0, 0]}\n"),
              AllOf(HasSubstr(":2: "), HasSubstr("'upper' is missing")));
  EXPECT_THAT(complaint("room: {lower: [0, 0, 0], upper: [1, 0, 1]}\n"), HasSubstr("above lower"));
  EXPECT_THAT(complaint("room: [0, 1]\n"), HasSubstr("map"));
  EXPECT_THAT(complaint("planes: []\nplanes: []\n"), AllOf(HasSubstr(":2: "), HasSubstr("twice")));
  EXPECT_THAT(complaint("planes:\n  - {point: [0, 0, 1]}\n"),
              AllOf(HasSubstr(":2: "), HasSubstr("'normal' is missing")));
  EXPECT_THAT(complaint("planes:\n  - point: [0, 0, 1]\n    normal: [0, 0, 0]\n"),
              AllOf(HasSubstr(":3: "), HasSubstr("zero")));
  EXPECT_THAT(complaint("planes:\n  - point: [0, 0]\n    normal: [0, 0, 1]\n"),
              AllOf(HasSubstr(":2: "), HasSubstr("3 numbers")));
  EXPECT_THAT(complaint("boxes:\n  - size: [1, 1, x]\n    position: [0, 0, 1]\n"),
              AllOf(HasSubstr(":2: "), HasSubstr("finite numbers")));
  EXPECT_THAT(complaint("boxes:\n  - size: [1, 1, .nan]\n    position: [0, 0, 1]\n"),
              HasSubstr("finite numbers"));
  EXPECT_THAT(complaint("boxes:\n  - size: [1, 1, -1]\n    position: [0, 0, 1]\n"),
              AllOf(HasSubstr(":2: "), HasSubstr("positive")));
  EXPECT_THAT(complaint("boxes:\n  - size: [1, 1, 1]\n    position: [0, 0, 1]\n    frame: moon\n"),
              AllOf(HasSubstr(":4: "), HasSubstr("world or base")));
  EXPECT_THAT(complaint("arms:\n  - radius: 0\n"), AllOf(HasSubstr(":2: "), HasSubstr("positive")));
  EXPECT_THAT(complaint("arms:\n  - radius: 0.1\n"), HasSubstr("two waypoints"));
  EXPECT_THAT(complaint("arms:\n  - waypoints:\n"
                        "      - {time: 0.5, shoulder: [0, 0, 1], wrist: [0, 0, 1]}\n"
                        "      - {time: 0.4, shoulder: [0, 0, 1], wrist: [0, 0, 1]}\n"),
              AllOf(HasSubstr(":4: "), HasSubstr("grow")));
}

}  // namespace
}  // namespace lockbox
