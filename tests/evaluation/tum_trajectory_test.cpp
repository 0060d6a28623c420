// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/tum_trajectory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lockbox/core/error.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class TumTrajectory : public testing::Test {
 protected:
  void write(const std::string& text) const { folder_.write("trajectory.txt", text); }

  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "trajectory.txt";
};

TEST_F(TumTrajectory, FilesOfTheDataSetsAreRead) {
  write(
      "# ground truth trajectory\r\n# file: 'rgbd.bag'\r\n# timestamp tx ty tz qx qy qz qw\r\n"
      "1305031098.6659 1.3563 0.6305 1.6380 0.6132 0.5962 -0.3311 -0.3986\r\n\r\n"
      "  1305031098.6758\t1.3543 0.6306 1.6360 0 0 0.6 0.8 \r\n");
  ASSERT_TRUE(is_tum_trajectory(file_));
  const StatesFile read = read_tum_trajectory(file_);
  ASSERT_EQ(read.states.size(), 2U);
  EXPECT_EQ(read.states[0].stamp, 1305031098.6659);
  EXPECT_EQ(read.states[1].configuration.T_camera_base.translation(),
            Eigen::Vector3d(1.3543, 0.6306, 1.6360));
  EXPECT_NEAR(read.states[1].configuration.T_camera_base.linear()(1, 0), 0.96, 1e-12);
}

TEST_F(TumTrajectory, OtherFilesAreNone) {
  for (const char* const text : {"", "# nothing\n", "timestamp,tx,ty,tz,qx,qy,qz,qw\n0,0,0,1\n",
                                 "1 2 3 4 5 6 7\n", "1 2 3 4 5 6 7 8 9\n", "0.0 depth/0.png\n"}) {
    write(text);
    EXPECT_FALSE(is_tum_trajectory(file_)) << text;
  }
  EXPECT_FALSE(is_tum_trajectory("/nonexistent"));
}

TEST_F(TumTrajectory, ProblemsNameTheLine) {
  write("0 0 0 1 0 0 0 1\n0.1 0 0 1 0 0 0\n");
  EXPECT_THAT([this] { read_tum_trajectory(file_); },
              ThrowsMessage<InputError>(HasSubstr(".txt:2: expected eight numbers")));
  write("0 0 0 1 0 0 0 2\n");
  EXPECT_THAT([this] { read_tum_trajectory(file_); },
              ThrowsMessage<InputError>(HasSubstr(".txt:1: the quaternion")));
}

}  // namespace
}  // namespace lockbox
