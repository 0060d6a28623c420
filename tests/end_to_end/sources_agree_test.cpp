// SPDX-License-Identifier: BSD-3-Clause
// The frames that a recording's player delivers, written as depth images and as organized clouds:
// the lockbox comes out the same from all three.
#include <gmock/gmock.h>

#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/pcd_folder.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/states_file.hpp"
#include "tool.hpp"

namespace lockbox {
namespace {

constexpr double kAgreement = 1e-9;  // metres, radians: the same depths, stamps and camera

class SourcesAgree : public testing::Test {
 protected:
  const TemporaryFolder folder;
  const KinematicTree tree = load_kinematic_tree(LOCKBOX_MODELS "/lockbox/lockbox.urdf");

  std::string path(const std::string& name) const { return (folder / name).string(); }

  void record() const {
    const auto simulated =
        run_tool({"simulate", "--model", "lockbox", "--trajectory", "auto", "--frames", "40",
                  "--scene", "room", "--output", path("lockbox.oni")});
    ASSERT_EQ(simulated.status, 0) << simulated.errors;
  }

  /// Writes what the player delivers.
  void convert() const {
    OniPlayer player(folder / "lockbox.oni");
    DepthFrame frame;
    ASSERT_TRUE(player.next(frame));
    DepthFolderWriter images(folder / "images");
    const PcdFolderWriter clouds(folder / "clouds");
    do {
      images.write(frame);
      clouds.write(frame);
    } while (player.next(frame));
  }

  std::vector<State> track(const std::string& source) const {
    const auto tracked =
        run_tool({"track", "--model", "lockbox", "--source", path(source), "--initial-state",
                  path("groundtruth.csv"), "--camera-info", path("images/camera_info.yaml"),
                  "--output", path(source + ".run")});
    EXPECT_EQ(tracked.status, 0) << tracked.errors;
    return read_states(path(source + ".run/states.csv"), tree).states;
  }

  void expect_agreement(const std::vector<State>& a, const std::vector<State>& b) const {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_NEAR(a[i].stamp, b[i].stamp, 1e-6);
      const Eigen::Isometry3d difference =
          a[i].configuration.T_camera_base.inverse() * b[i].configuration.T_camera_base;
      EXPECT_LT(difference.translation().norm(), kAgreement) << "frame " << i;
      EXPECT_LT(Eigen::AngleAxisd(difference.linear()).angle(), kAgreement) << "frame " << i;
      EXPECT_LT((a[i].configuration.q - b[i].configuration.q).cwiseAbs().maxCoeff(), kAgreement)
          << "frame " << i;
    }
  }
};

TEST_F(SourcesAgree, OnTheLockboxFromRecordingImagesAndClouds) {
  record();
  convert();
  const auto from_recording = track("lockbox.oni");
  ASSERT_EQ(from_recording.size(), 40U);
  expect_agreement(from_recording, track("images"));
  expect_agreement(from_recording, track("clouds"));
}

}  // namespace
}  // namespace lockbox
