// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/states_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "chains.hpp"
#include "lockbox/core/error.hpp"
#include "message_of.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

constexpr const char* kHeader = "timestamp,tx,ty,tz,qx,qy,qz,qw,joint0,joint1\n";

class StatesFileTest : public testing::Test {
 protected:
  StatesFileTest() {
    add_joint(tree_, 0, JointType::revolute, Eigen::Isometry3d::Identity(),
              Eigen::Vector3d::UnitX());
    add_joint(tree_, 0, JointType::prismatic, Eigen::Isometry3d::Identity(),
              Eigen::Vector3d::UnitZ());
  }

  StatesFile read(const std::string& text) const {
    return read_states(folder_.write("states.csv", text), tree_);
  }

  std::string refusal(const std::string& text) const {
    return message_of<InputError>([&] { read(text); });
  }

  const TemporaryFolder folder_;
  KinematicTree tree_;
};

TEST_F(StatesFileTest, KeepsEveryBitOfARoundTrip) {
  std::mt19937 generator{3};
  std::vector<State> states(20);
  for (State& state : states) {
    state.stamp = random_vector(generator).x();
    state.configuration.T_camera_base = random_pose(generator);
    state.configuration.q = random_vector(generator).head<2>();
  }
  write_states(folder_ / "a.csv", tree_, states);
  const StatesFile found = read_states(folder_ / "a.csv", tree_);
  ASSERT_EQ(found.states.size(), states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Configuration& expected = states[i].configuration;
    EXPECT_EQ(found.states[i].stamp, states[i].stamp);
    EXPECT_EQ(found.states[i].configuration.q, expected.q);
    EXPECT_TRUE(found.states[i].configuration.T_camera_base.translation() ==
                expected.T_camera_base.translation());
    EXPECT_LT(
        (found.states[i].configuration.T_camera_base.linear() - expected.T_camera_base.linear())
            .norm(),
        1e-14);
  }
}

TEST_F(StatesFileTest, WritesJointsInTheOrderOfTheModelFile) {
  tree_.file_order = {1, 0};
  EXPECT_EQ(states_header(tree_), "timestamp,tx,ty,tz,qx,qy,qz,qw,joint1,joint0");
  Configuration configuration = rest_configuration(tree_);
  configuration.q << 0.1, 0.2;
  EXPECT_EQ(states_row(tree_, 1.5, configuration), "1.5,0,0,0,0,0,0,1,0.2,0.1");
}

TEST_F(StatesFileTest, FindsColumnsByNameAndKeepsTheOthers) {
  const StatesFile file = read(
      "latency_ms,joint1,status,qw,qz,qy,qx,tz,ty,tx,timestamp,joint0.sigma,joint0\n"
      "4.5,0.25,tracking,1,0,0,0,3,2,1,10,nan,-1e-3\n");
  ASSERT_EQ(file.states.size(), 1U);
  EXPECT_THAT(file.extra_columns, ElementsAre("latency_ms", "joint0.sigma"));
  const State& state = file.states[0];
  EXPECT_EQ(state.stamp, 10.0);
  EXPECT_EQ(state.status, "tracking");
  EXPECT_EQ(state.configuration.T_camera_base.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(state.configuration.q, Eigen::Vector2d(-1e-3, 0.25));
  EXPECT_THAT(state.extra, ElementsAre("4.5", "nan"));
}

TEST_F(StatesFileTest, ReadsWindowsLineEndsBlanksAndAMissingLastLineEnd) {
  const StatesFile file = read(
      "\xEF\xBB\xBFtimestamp, tx, ty, tz, qx, qy, qz, qw, joint0, joint1\r\n"
      "0, 0, 0, 1, 0, 0, 0, 1, 0.5, 0\r\n"
      "1, 0, 0, 1, 0, 0, 0, 1, 0.6, 0");
  ASSERT_EQ(file.states.size(), 2U);
  EXPECT_EQ(file.states[1].configuration.q[0], 0.6);
}

TEST_F(StatesFileTest, TakesNanPosesForUnknownAndWritesThemBack) {
  const std::string row = "2,nan,nan,nan,nan,nan,nan,nan,nan,nan";
  const StatesFile file = read(kHeader + row + "\n");
  ASSERT_EQ(file.states.size(), 1U);
  EXPECT_FALSE(file.states[0].known);
  EXPECT_TRUE(std::isnan(file.states[0].configuration.q[1]));
  write_states(folder_ / "copy.csv", tree_, file.states);
  EXPECT_FALSE(read_states(folder_ / "copy.csv", tree_).states.at(0).known);
  EXPECT_EQ(states_row(tree_, 2.0, unknown_configuration(tree_)), row);
}

TEST_F(StatesFileTest, NormalisesQuaternionsWrittenWithFewDigits) {
  const StatesFile file = read(std::string(kHeader) + "0,0,0,1,0,0,0.707,0.707,0,0\n");
  const Eigen::Matrix3d R = file.states.at(0).configuration.T_camera_base.linear();
  EXPECT_TRUE(R.isUnitary(1e-14));
}

TEST_F(StatesFileTest, NeedsNoColumnForMimicJoints) {
  make_last_a_mimic(tree_, 0, 2.0, 0.0);
  const StatesFile file = read("timestamp,tx,ty,tz,qx,qy,qz,qw,joint0\n0,0,0,1,0,0,0,1,0.5\n");
  EXPECT_EQ(joint_position(tree_, file.states.at(0).configuration, 1), 1.0);
  EXPECT_THAT(states_row(tree_, 0.0, file.states[0].configuration), EndsWith(",0.5,1"));
}

TEST_F(StatesFileTest, RefusesBadHeaders) {
  EXPECT_THAT(refusal(""), HasSubstr("states.csv:1: column 1 has no name"));
  EXPECT_THAT(refusal("timestamp,tx,ty,tz,qx,qy,qz,joint0,joint1\n"),
              HasSubstr("states.csv:1: the column 'qw'"));
  EXPECT_THAT(refusal("timestamp,tx,ty,tz,qx,qy,qz,qw,joint0\n"),
              HasSubstr("states.csv:1: the column 'joint1' (a joint of the model) is missing"));
  EXPECT_THAT(refusal("timestamp,tx,tx,ty,tz,qx,qy,qz,qw,joint0,joint1\n"),
              HasSubstr("the column 'tx' stands there twice"));
}

TEST_F(StatesFileTest, RefusesBadValuesWithLineAndColumn) {
  const std::string good = "0,0,0,1,0,0,0,1,0,0\n";
  const auto second_row = [&](const std::string& row) { return refusal(kHeader + good + row); };
  EXPECT_THAT(second_row("0,0,0,1,0,0,0,1,0\n"), HasSubstr("states.csv:3: has 9 fields"));
  EXPECT_THAT(second_row("0,0,0,1,0,0,0,1,zero,0\n"),
              HasSubstr("states.csv:3: column 'joint0': 'zero' is neither"));
  EXPECT_THAT(second_row("0,0,0,1,0,0,0,1,1.5m,0\n"), HasSubstr("column 'joint0': '1.5m'"));
  EXPECT_THAT(second_row("0,inf,0,1,0,0,0,1,0,0\n"), HasSubstr("column 'tx': 'inf'"));
  EXPECT_THAT(second_row("0,,0,1,0,0,0,1,0,0\n"), HasSubstr("column 'tx': ''"));
  EXPECT_THAT(second_row("nan,0,0,1,0,0,0,1,0,0\n"), HasSubstr("column 'timestamp'"));
  EXPECT_THAT(second_row("0,nan,0,1,0,0,0,1,0,0\n"), HasSubstr("known or nan as a whole"));
  EXPECT_THAT(second_row("0,0,0,1,0,0,0,0.9,0,0\n"), HasSubstr("column 'qx': the quaternion"));
  EXPECT_THAT(second_row("0,0,0,1,0,0,0,0,0,0\n"), HasSubstr("column 'qx': the quaternion"));
}

TEST_F(StatesFileTest, NamesFilesOfOtherKindsAndWhatToDoWithThem) {
  const auto refusal_of = [&](const std::string& name, const std::string& bytes) {
    const auto file = folder_.write(name, bytes);
    return message_of<InputError>([&] { read_states(file, tree_); });
  };
  EXPECT_THAT(refusal_of("a.png", "\x89PNG\r\n\x1a\n"),
              HasSubstr("is an image, not a states file"));
  EXPECT_THAT(refusal_of("a", "NI10...."), HasSubstr("a recording of OpenNI, not a states file"));
  EXPECT_THAT(refusal_of("run.yaml", "command: lockbox"), HasSubstr("states.csv of a run"));
  EXPECT_THAT(refusal_of("a.npy", "\x93NUMPY"), HasSubstr("as text"));
  EXPECT_THAT(refusal_of("a.csv", "#timestamp [ns],p_RS_R_x [m]\n1,2\n"), HasSubstr("evo_traj"));
  EXPECT_THAT(refusal_of("a.txt", "1 0 0 0 0 1 0 0 0 0 1 2\n"), HasSubstr("KITTI"));
  EXPECT_THAT(refusal_of("base.tum", "# timestamp tx ty tz\n0.0 0 0 1 0 0 0 1\n"),
              HasSubstr("is a TUM trajectory, not a states file; put commas"));
}

TEST_F(StatesFileTest, RefusesWhatIsNotAFile) {
  EXPECT_THAT(message_of<InputError>([&] { read_states(folder_ / "none.csv", tree_); }),
              EndsWith("none.csv: no such file"));
  EXPECT_THAT(message_of<InputError>([&] { read_states(folder_.path(), tree_); }),
              EndsWith("is a folder; give the file in it"));
  EXPECT_THAT(message_of<InputError>([&] { write_states(folder_ / "a/b.csv", tree_, {}); }),
              HasSubstr("b.csv: cannot be written"));
}

}  // namespace
}  // namespace lockbox
