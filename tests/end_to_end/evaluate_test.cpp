// SPDX-License-Identifier: BSD-3-Clause
// What `lockbox evaluate` says of references that do not fit, and of trajectories without joints.
#include <gmock/gmock.h>

#include <string>

#include "tool.hpp"

namespace lockbox {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr char kPose[] = "timestamp,tx,ty,tz,qx,qy,qz,qw";

class EvaluateTool : public testing::Test {
 protected:
  /// A states file of so many frames, 30 a second, at a place along x, with these joints at 0.1.
  std::string write_states(const std::string& name, int frames, double first, double x,
                           const std::vector<std::string>& joints) {
    std::string text = kPose;
    for (const auto& joint : joints) text += "," + joint;
    text += ",status\n";
    for (int i = 0; i < frames; ++i) {
      text += std::to_string(first + i / 30.0) + "," + std::to_string(x) + ",0,1,0,0,0,1";
      for (std::size_t joint = 0; joint < joints.size(); ++joint) text += ",0.1";
      text += ",tracking\n";
    }
    write_text(folder_ / name, text);
    return folder_ / name;
  }

  ToolResult evaluate(const std::string& reference) const {
    return run_tool({"evaluate", "--estimate", folder_ / "states.csv", "--reference", reference});
  }

  TemporaryFolder folder_;
};

TEST_F(EvaluateTool, TumTrajectoriesAreReferencesOfTheBase) {
  write_states("states.csv", 12, 0.0, 0.0, {"door"});
  std::string trajectory = "# timestamp tx ty tz qx qy qz qw\n";
  for (int i = 0; i < 100; ++i) {
    trajectory += std::to_string(i / 200.0) + " 0.002 0 1 0 0 0 1\n";
  }
  write_text(folder_ / "groundtruth.txt", trajectory);
  const auto result = evaluate(folder_ / "groundtruth.txt");
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.output, AllOf(HasSubstr("base translation"), HasSubstr("2.000"),
                                   HasSubstr("12 of 12 frames"), Not(HasSubstr("door"))));
  EXPECT_THAT(result.errors, HasSubstr("joints are not compared"));
  const auto exchanged = run_tool({"evaluate", "--estimate", folder_ / "groundtruth.txt",
                                   "--reference", folder_ / "states.csv"});
  EXPECT_EQ(exchanged.status, 3);
  EXPECT_THAT(exchanged.errors, HasSubstr("give the states.csv"));
}

TEST_F(EvaluateTool, TheTruthOfAnotherRecordingOrModelIsNamed) {
  write_states("states.csv", 12, 0.0, 0.0, {"door"});
  const auto later = evaluate(write_states("later.csv", 12, 50.0, 0.0, {"door"}));
  EXPECT_EQ(later.status, 3);
  EXPECT_THAT(later.errors, HasSubstr("another recording"));
  const auto other = evaluate(write_states("other.csv", 12, 0.0, 0.0, {"lid", "flap"}));
  EXPECT_EQ(other.status, 3);
  EXPECT_THAT(other.errors,
              AllOf(HasSubstr("another model"), HasSubstr("lid, flap"), HasSubstr("model door")));
  const auto more = evaluate(write_states("more.csv", 12, 0.0, 0.0, {"door", "flap"}));
  EXPECT_EQ(more.status, 0);
  EXPECT_THAT(more.errors, HasSubstr("has not: flap"));
  const auto wrong = evaluate(write_states("wrong.csv", 12, 0.0, 0.5, {"door"}));
  EXPECT_EQ(wrong.status, 0);
  EXPECT_THAT(wrong.errors, HasSubstr("the truth of this recording"));
}

TEST_F(EvaluateTool, OneFrameIsOneFrame) {
  const auto file = write_states("states.csv", 1, 0.0, 0.0, {});
  const auto result = evaluate(file);
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("1 of 1 frame tracked"));
}

TEST_F(EvaluateTool, AFolderIsNamedAsOne) {
  write_states("states.csv", 12, 0.0, 0.0, {});
  EXPECT_THAT(evaluate(folder_ / "").errors, HasSubstr("is a folder; give"));
}

TEST_F(EvaluateTool, AReferenceInMillimetresIsSaidToBe) {
  write_states("states.csv", 12, 0.0, 0.02, {});
  std::string text = std::string(kPose) + "\n";
  std::string trajectory;
  for (int i = 0; i < 12; ++i) {
    const auto stamp = std::to_string(i / 30.0);
    text += stamp + ",20,0,1000,0,0,0,1\n";
    trajectory += stamp + " 20 0 1000 0 0 0 1\n";
  }
  write_text(folder_ / "mm.csv", text);
  write_text(folder_ / "mm.txt", trajectory);
  for (const auto* name : {"mm.csv", "mm.txt"}) {
    const auto result = evaluate(folder_ / name);
    EXPECT_EQ(result.status, 0) << name;
    EXPECT_THAT(result.errors, HasSubstr("in millimetres: divide them by 1000")) << name;
  }
}

TEST_F(EvaluateTool, PosesThatLookTheSameCountAsEqualWhereNoJointMoves) {
  const std::string pose = std::string(kPose) + ",slide,status\n0,0,0,1,";
  write_text(folder_ / "states.csv", pose + "1,0,0,0,0,tracking\n");
  write_text(folder_ / "truth.csv", pose + "0,0,0,1,0,tracking\n");
  const auto compare = [&](const std::string& model) {
    return run_tool(
        {"evaluate", "-e", folder_ / "states.csv", "-r", folder_ / "truth.csv", "--model", model});
  };
  const auto rigid = compare("carton");
  EXPECT_THAT(rigid.output, HasSubstr("of these wrong: 0"));
  EXPECT_THAT(rigid.errors, AllOf(HasSubstr("180 degrees about x"), HasSubstr("nearest of these")));
  const auto jointed = compare("carton_pair");
  EXPECT_THAT(jointed.output, HasSubstr("of these wrong: 1"));
  EXPECT_THAT(jointed.errors, AllOf(HasSubstr("with its joints at rest"), HasSubstr("as wrong")));
  EXPECT_THAT(compare("rigid_block").errors, Not(HasSubstr("looks the same")));
}

}  // namespace
}  // namespace lockbox
