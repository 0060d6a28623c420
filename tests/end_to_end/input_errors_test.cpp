// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <random>

#include "block_recording.hpp"
#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;

ToolResult track(const std::string& source) {
  return run_tool({"track", "--model", "rigid_block", "--source", source});
}

void expect_refused(const std::filesystem::path& source) {
  const auto result = track(source.string());
  EXPECT_EQ(result.status, 3) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr(source.string()));
}

TEST(Recording, ThatIsMissingIsNamed) {
  const TemporaryFolder folder;
  expect_refused(folder / "missing.oni");
}

TEST(Recording, ThatIsEmptyTextOrRandomIsRefused) {
  const TemporaryFolder folder;
  write_text(folder / "empty.oni", "");
  write_text(folder / "text.oni", "This is not a recording.\n");
  std::mt19937 random(1);
  std::string noise(4096, '\0');
  for (char& byte : noise) byte = static_cast<char>(random() & 0xFFU);
  write_text(folder / "random.oni", noise);
  for (const auto* name : {"empty.oni", "text.oni", "random.oni"}) expect_refused(folder / name);
}

TEST(Recording, ThatIsTruncatedIsPlayedUpToTheCut) {
  const TemporaryFolder folder;
  const auto simulated =
      run_tool({"simulate", "--model", "rigid_block", "--trajectory", "auto", "--frames", "5",
                "--output", (folder / "whole.oni").string(), "--quiet"});
  ASSERT_EQ(simulated.status, 0) << simulated.errors;
  const std::string whole = read_text(folder / "whole.oni");
  for (const std::size_t share : {3U, 6U}) {
    write_text(folder / "truncated.oni", whole.substr(0, whole.size() * share / 7));
    const auto result = track((folder / "truncated.oni").string());
    EXPECT_EQ(result.status, 0) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("breaks off at byte"));
  }
  write_text(folder / "truncated.oni", whole.substr(0, 100));  // no image is complete
  expect_refused(folder / "truncated.oni");
}

/// As track takes it.
TEST(Folder, OfWhichTheCameraIsGivenIsRecorded) {
  const TemporaryFolder folder;
  write_text(folder / "state.csv", "timestamp,tx,ty,tz,qx,qy,qz,qw\n0,0,0,1,0,0,0,1\n");
  ASSERT_EQ(run_tool({"simulate", "--model", "rigid_block", "--trajectory", folder / "state.csv",
                      "--output", folder / "images"})
                .status,
            0);
  std::filesystem::rename(folder / "images/camera_info.yaml", folder / "camera.yaml");
  const auto record = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"record", "--source", folder / "images", "--output",
                                          folder / "a.oni"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tool(arguments);
  };
  const auto refused = record({});
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.errors, HasSubstr("--camera-info"));
  const auto fifths = record({"--camera-info", folder / "camera.yaml", "--depth-scale", "5000"});
  EXPECT_EQ(fifths.status, 3);
  EXPECT_THAT(fifths.errors, HasSubstr("not of 0.2 mm; a depth folder can"));
  EXPECT_EQ(record({"--camera-info", folder / "camera.yaml"}).status, 0);
}

TEST(Folder, WithoutDepthImagesIsRefused) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "nothing");
  expect_refused(folder / "nothing");
}

TEST(Device, ThatIsNotThereFails) {
  const auto result = track("openni2:no-such-device");
  EXPECT_EQ(result.status, 4) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("no-such-device"));
}

TEST(Model, ThatIsMissingIsAnsweredWithTheShippedOnes) {
  const auto result = run_tool({"inspect", "--model", "lokbox"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("lokbox"));
  EXPECT_THAT(result.errors, HasSubstr("rigid_block"));
}

TEST(Model, ThatIsBrokenIsRefusedWithFileAndLine) {
  const TemporaryFolder folder;
  write_text(folder / "broken.urdf", "<robot name=\"x\">\n  <link name=\"a\">\n</robot>\n");
  const auto result = run_tool({"inspect", "--model", (folder / "broken.urdf").string()});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, testing::ContainsRegex("broken\\.urdf:[0-9]+: "));
}

constexpr const char* kTetrahedronInMillimetres =
    "v 0 0 0\nv 200 0 0\nv 0 200 0\nv 0 0 200\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST(Model, InMillimetresIsRefusedUntilItsUnitIsNamed) {
  const TemporaryFolder folder;
  const std::string mesh = (folder / "tetrahedron.obj").string();
  write_text(mesh, kTetrahedronInMillimetres);
  const auto refused = run_tool({"inspect", "--model", mesh});
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.errors, HasSubstr("millimetres"));
  EXPECT_THAT(refused.errors, HasSubstr("--mesh-scale 0.001"));
  const auto taken = run_tool({"inspect", "--model", mesh, "--mesh-scale", "0.001"});
  EXPECT_EQ(taken.status, 0) << taken.errors;
  EXPECT_EQ(taken.errors, "");
  EXPECT_EQ(run_tool({"inspect", "--model", mesh, "--mesh-scale", "0"}).status, 2);
}

/// An evaluation loads the model of the run as the run did.
TEST(Model, InMillimetresIsKnownFromItsRun) {
  const TemporaryFolder folder;
  const std::string mesh = (folder / "tetrahedron.obj").string();
  const std::string states = (folder / "states.csv").string();
  write_text(mesh, kTetrahedronInMillimetres);
  write_text(states, "timestamp,tx,ty,tz,qx,qy,qz,qw,status\n0,0,0,1,0,0,0,1,tracking\n");
  const std::string run = "model: " + mesh + "\noptions:\n  mesh-scale: ";
  const auto result_with = [&](const std::string& scale) {
    write_text(folder / "run.yaml", run + scale + "\n");
    return run_tool({"evaluate", "--estimate", states, "--reference", states});
  };
  EXPECT_EQ(result_with("0.001").status, 0);
  EXPECT_EQ(result_with("1").status, 3);
  for (const char* const scale : {"-1", "0", ".nan", ".inf", "1e999", "small"}) {
    const auto result = result_with(scale);
    EXPECT_EQ(result.status, 3) << scale;
    EXPECT_THAT(result.errors, HasSubstr("run.yaml:3: 'mesh-scale' must be a positive number"));
  }
}

TEST(Model, OfAFolderIsAnsweredWithTheFilesInIt) {
  const auto result = run_tool({"inspect", "--model", LOCKBOX_MODELS "/cabinet"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("cabinet.urdf"));
}

/// A surface of 15 m is sampled for its contacts, too.
TEST(Model, AsLargeAsAHallKeepsWithinTheMemory) {
  const TemporaryFolder folder;
  const std::string urdf = (folder / "hall.urdf").string();
  write_text(urdf,
             "<robot name=\"r\"><link name=\"a\"><visual><geometry><box size=\"15 15 15\"/>"
             "</geometry></visual></link></robot>");
  const auto result = run_tool({"inspect", "--model", urdf});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("15 m large"));
}

TEST(Recording, ThatIsTheSourceIsNotOverwritten) {
  const TemporaryFolder folder;
  simulate_block(folder);
  const std::string before = read_text(folder / "new/block.oni");
  std::filesystem::create_symlink("new/block.oni", folder / "other.oni");
  for (const auto* name : {"new/block.oni", "other.oni"}) {
    const auto result = run_tool({"track", "--model", "rigid_block", "--source",
                                  folder / "new/block.oni", "--record", folder / name});
    EXPECT_EQ(result.status, 3) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr(name));
  }
  EXPECT_EQ(read_text(folder / "new/block.oni"), before);
}

/// Whoever mends the output first would hear of the typo only then.
TEST(CommandLine, IsCheckedBeforeTheFilesOfEarlierRuns) {
  const TemporaryFolder folder;
  simulate_block(folder);
  std::filesystem::create_directory(folder / "run");
  write_text(folder / "run/states.csv", "");
  const auto errors_of = [](std::vector<std::string> arguments) {
    const auto result = run_tool(arguments);
    EXPECT_EQ(result.status, 3);
    EXPECT_THAT(result.errors, testing::Not(HasSubstr("--overwrite")));
    return result.errors;
  };
  const auto simulated = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"simulate", "--output", folder / "new/block.oni"});
    return errors_of(more);
  };
  const std::string state = folder / "state.csv";
  EXPECT_THAT(simulated({"-m", "rigid_blok", "-t", state}), HasSubstr("rigid_blok"));
  EXPECT_THAT(simulated({"-m", "rigid_block", "-t", "stat.csv"}), HasSubstr("stat.csv"));
  EXPECT_THAT(simulated({"-m", "rigid_block", "-t", state, "--scene", "rom"}), HasSubstr("rom"));
  EXPECT_THAT(simulated({"-m", "rigid_block", "-t", state, "--sensor", "idel"}), HasSubstr("idel"));
  const auto tracked = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"track", "--output", folder / "run"});
    return errors_of(more);
  };
  const std::string recording = folder / "new/block.oni";
  EXPECT_THAT(tracked({"-m", "rigid_blok", "-s", recording}), HasSubstr("rigid_blok"));
  EXPECT_THAT(tracked({"-m", "rigid_block", "-s", "blok.oni"}), HasSubstr("blok.oni"));
  EXPECT_THAT(tracked({"-m", "rigid_block", "-s", recording, "--initial-state", "stat.csv"}),
              HasSubstr("stat.csv"));
  EXPECT_THAT(tracked({"-m", "rigid_block", "-s", recording, "--camera-info", "camra.yaml"}),
              HasSubstr("camra.yaml"));
  EXPECT_THAT(errors_of({"record", "-s", "blok.oni", "-o", recording}), HasSubstr("blok.oni"));
  EXPECT_THAT(errors_of({"experiment", "order", "-m", "lokbox", "-o", folder / "order"}),
              HasSubstr("lokbox"));
  EXPECT_FALSE(std::filesystem::exists(folder / "order"));
}

/// Two files are compared, and either may be the one to mend.
TEST(States, ThatCannotBeUsedAreNamed) {
  const TemporaryFolder folder;
  const std::string header = "timestamp,tx,ty,tz,qx,qy,qz,qw\n";
  write_text(folder / "good.csv", header + "0,0,0,1,0,0,0,1\n1,0,0,1,0,0,0,1\n");
  write_text(folder / "empty.csv", header);
  write_text(folder / "back.csv", header + "1,0,0,1,0,0,0,1\n0,0,0,1,0,0,0,1\n");
  write_text(folder / "unknown.csv", header + "0,nan,nan,nan,nan,nan,nan,nan\n");
  const auto evaluated = [&folder](const char* estimate, const char* reference) {
    return run_tool({"evaluate", "--model", "rigid_block", "--estimate", folder / estimate,
                     "--reference", folder / reference})
        .errors;
  };
  EXPECT_EQ(evaluated("good.csv", "good.csv"), "");
  for (const auto* wrong : {"empty.csv", "back.csv"}) {
    EXPECT_THAT(evaluated(wrong, "good.csv"), HasSubstr(wrong));
    EXPECT_THAT(evaluated("good.csv", wrong), HasSubstr(wrong));
  }
  const auto simulated = run_tool({"simulate", "--model", "rigid_block", "--trajectory",
                                   folder / "unknown.csv", "--output", folder / "images"});
  EXPECT_EQ(simulated.status, 3);
  EXPECT_THAT(simulated.errors, HasSubstr("unknown.csv: state 1"));
}

TEST(OutputFolder, ThatCannotBeIsNamed) {
  const TemporaryFolder folder;
  simulate_block(folder);
  const auto result = run_tool({"track", "--model", "rigid_block", "--source",
                                folder / "new/block.oni", "--output", folder / "state.csv/run"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("state.csv/run: cannot be made a folder"));
}

TEST(Joint, ThatIsUnknownIsAnsweredWithTheNearest) {
  const TemporaryFolder folder;
  simulate_block(folder);
  const auto result = run_tool(
      {"track", "--model", "cabinet", "--source", folder / "new/block.oni", "--lock-joint", "dor"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("--lock-joint"));
  EXPECT_THAT(result.errors, HasSubstr("did you mean door?"));
}

}  // namespace
}  // namespace lockbox
