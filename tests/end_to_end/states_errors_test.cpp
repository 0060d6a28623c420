// SPDX-License-Identifier: BSD-3-Clause
// What is said of states files that cannot be used as what they were given for.
#include <gmock/gmock.h>

#include "block_recording.hpp"
#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;

TEST(States, WithWrongColumnsAreRefusedWithFileAndLine) {
  const TemporaryFolder folder;
  const auto file = (folder / "states.csv").string();
  write_text(file, "timestamp,tx,ty,tz,qx,qy,qz,qw\n0,0,0,1,0,0,0,1\n0.1,0,0,one,0,0,0,1\n");
  const auto result = run_tool({"simulate", "--model", "rigid_block", "--trajectory", file,
                                "--output", (folder / "out").string()});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("states.csv:3"));
}

TEST(States, InMillimetresAreRefused) {
  const TemporaryFolder folder;
  const std::string header = "timestamp,tx,ty,tz,qx,qy,qz,qw\n";
  write_text(folder / "m.csv", header + "0,0,0,1,0,0,0,1\n");
  write_text(folder / "mm.csv", header + "0,0,0,1000,0,0,0,1\n");
  const auto simulate = [&](const std::string& states) {
    return run_tool({"simulate", "--model", "rigid_block", "--trajectory", folder / states,
                     "--output", folder / ("out_" + states + "/")});
  };
  ASSERT_EQ(simulate("m.csv").status, 0);
  const auto simulated = simulate("mm.csv");
  EXPECT_EQ(simulated.status, 3);
  EXPECT_THAT(simulated.errors, HasSubstr("mm.csv: state 1 puts the base 1000 m away"));
  EXPECT_THAT(simulated.errors, HasSubstr("divide them by 1000"));
  const auto tracked = run_tool({"track", "--model", "rigid_block", "--source",
                                 folder / "out_m.csv/", "--initial-state", folder / "mm.csv"});
  EXPECT_EQ(tracked.status, 3);
  EXPECT_THAT(tracked.errors, HasSubstr("in millimetres"));
}

TEST(States, WithJointsInDegreesOrMillimetresAreNamed) {
  const TemporaryFolder folder;
  const auto model = folder.write("cupboard.urdf", R"(<robot name="cupboard">
  <link name="box"><visual><geometry><box size="0.4 0.4 0.4"/></geometry></visual></link>
  <link name="lid"><visual><geometry><box size="0.3 0.3 0.02"/></geometry></visual></link>
  <link name="tray"><visual><geometry><box size="0.2 0.2 0.02"/></geometry></visual></link>
  <joint name="hinge" type="revolute"><parent link="box"/><child link="lid"/>
    <origin xyz="0 0 0.3"/><axis xyz="1 0 0"/><limit lower="0" upper="1.9"/></joint>
  <joint name="slide" type="prismatic"><parent link="box"/><child link="tray"/>
    <origin xyz="0 0 -0.3"/><axis xyz="1 0 0"/><limit lower="0" upper="0.2"/></joint>
</robot>)");
  const auto states = [&](const std::string& joints) {
    return folder.write("states.csv",
                        "timestamp,tx,ty,tz,qx,qy,qz,qw,hinge,slide\n0,0,0,1.5,0,0,0,1," + joints);
  };
  const auto simulate = [&](const std::string& joints) {
    return run_tool({"simulate", "--model", model, "--trajectory", states(joints), "--output",
                     folder / "out", "--overwrite"});
  };
  EXPECT_EQ(simulate("1.95,0.21").status, 0) << "no model is exact";
  const auto degrees = simulate("60,0");
  EXPECT_EQ(degrees.status, 3);
  EXPECT_THAT(degrees.errors, HasSubstr("states.csv: state 1 puts joint 'hinge' to 60"));
  EXPECT_THAT(degrees.errors, HasSubstr("seem to be in degrees: multiply them by 0.01745"));
  EXPECT_THAT(simulate("1,150").errors, HasSubstr("in millimetres: divide them by 1000"));
  const auto started = run_tool({"track", "--model", model, "--source", folder / "out",
                                 "--initial-state", states("-30,0.1")});
  EXPECT_EQ(started.status, 3);
  EXPECT_THAT(started.errors, HasSubstr("far beyond its limits, 0 to 1.9"));
  const auto evaluated = run_tool({"evaluate", "--model", model, "--estimate",
                                   folder / "out/groundtruth.csv", "--reference", states("60,0")});
  EXPECT_EQ(evaluated.status, 0);
  EXPECT_THAT(evaluated.errors, HasSubstr("seem to be in degrees"));
}

TEST(Trajectory, IsNotOverwrittenByItsTruth) {
  const TemporaryFolder folder;
  const std::string states = "timestamp,tx,ty,tz,qx,qy,qz,qw\n7,0,0,1,0,0,0,1\n";
  write_text(folder / "groundtruth.csv", states);
  const auto result = run_tool({"simulate", "--model", "rigid_block", "--trajectory",
                                folder / "groundtruth.csv", "--output", folder / "block.oni"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("groundtruth.csv"));
  EXPECT_EQ(read_text(folder / "groundtruth.csv"), states);
}

TEST(Estimate, ThatIsMissingOrItsReferenceIsNamed) {
  const TemporaryFolder folder;
  simulate_block(folder);
  const std::string there = folder / "new/groundtruth.csv";
  EXPECT_THAT(run_tool({"evaluate", "-e", "nope.csv", "-r", there}).errors,
              HasSubstr("nope.csv: there is no such file"));
  EXPECT_THAT(run_tool({"evaluate", "-e", there, "-r", "nope.csv"}).errors,
              HasSubstr("nope.csv: there is no such file"));
}

TEST(Estimate, OfARunWhoseModelNeedsAPackagePathIsComparedWithIt) {
  const TemporaryFolder folder;
  const TemporaryFolder packages;
  std::filesystem::create_directory(packages / "blocks");
  std::filesystem::copy(LOCKBOX_MODELS "/rigid_block/meshes", packages / "blocks/meshes");
  const auto mesh = std::filesystem::directory_iterator(packages / "blocks/meshes")->path();
  write_text(folder / "block.urdf",
             "<robot name=\"r\"><link name=\"block\"><visual><geometry><mesh filename=\""
             "package://blocks/meshes/" +
                 mesh.filename().string() + "\"/></geometry></visual></link></robot>");
  write_text(folder / "run.yaml", "model: " + (folder / "block.urdf").string() + "\n");
  const auto file = folder / "states.csv";
  write_text(file, "timestamp,tx,ty,tz,qx,qy,qz,qw\n0,0,0,1,0,0,0,1\n");
  EXPECT_EQ(run_tool({"evaluate", "--estimate", file, "--reference", file}).status, 3);
  const auto result = run_tool(
      {"evaluate", "--estimate", file, "--reference", file, "--package-path", packages / "."});
  EXPECT_EQ(result.status, 0) << result.errors;
}

TEST(Estimate, WhoseModelIsUnknownIsComparedWithAWarning) {
  const TemporaryFolder folder;
  const std::string states = "timestamp,tx,ty,tz,qx,qy,qz,qw,slide\n0,0,0,1,0,0,0,1,0.1\n";
  write_text(folder / "states.csv", states);
  const auto file = folder / "states.csv";
  const auto result = run_tool({"evaluate", "--estimate", file, "--reference", file});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.errors, HasSubstr("--model"));
}

}  // namespace
}  // namespace lockbox
