// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<std::string> kCommands = {
    "track", "simulate", "record", "evaluate", "experiment", "inspect", "view", "devices", "cache"};

TEST(Help, ListsAllCommands) {
  const auto result = run_tool({"--help"});
  EXPECT_EQ(result.status, 0);
  for (const auto& command : kCommands) EXPECT_THAT(result.output, HasSubstr("  " + command + " "));
}

TEST(Help, OfEachCommandShowsItsOptionsAndAnExample) {
  for (const auto& command : kCommands) {
    const auto result = run_tool({command, "--help"});
    EXPECT_EQ(result.status, 0) << command;
    EXPECT_THAT(result.output, HasSubstr("Example:\n  lockbox " + command + " "));
    EXPECT_THAT(result.output, HasSubstr("--config"));
    EXPECT_THAT(result.output, HasSubstr("130"));
    EXPECT_THAT(result.errors, IsEmpty());
  }
}

TEST(Help, OfACommandIsGivenHoweverItIsAskedFor) {
  const std::string help = run_tool({"track", "--help"}).output;
  EXPECT_EQ(run_tool({"help", "track"}).output, help);
  EXPECT_EQ(run_tool({"track", "help"}).output, help);
  EXPECT_EQ(run_tool({"--help", "track"}).output, help);
  const auto mistyped = run_tool({"help", "trakc"});
  EXPECT_EQ(mistyped.status, 2);
  EXPECT_THAT(mistyped.errors, HasSubstr("did you mean track?"));
}

TEST(Help, OfTrackSaysWhenNothingWasTracked) {
  EXPECT_THAT(run_tool({"track", "--help"}).output,
              testing::ContainsRegex("5: done, but no frame"));
}

TEST(Version, IsSaid) {
  const auto result = run_tool({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.output, testing::ContainsRegex("^lockbox [0-9]+\\.[0-9]+\\.[0-9]+"));
}

TEST(Usage, UnknownOptionsAreRefusedByName) {
  for (const auto& command : kCommands) {
    const auto result = run_tool({command, "--no-such-option"});
    EXPECT_EQ(result.status, 2) << command;
    EXPECT_THAT(result.errors, HasSubstr("lockbox " + command + " --help"));
  }
  EXPECT_THAT(run_tool({"inspect", "--model", "lockbox", "--no-such-option"}).errors,
              HasSubstr("--no-such-option"));
}

TEST(Usage, MissingOptionsAreNamed) {
  const auto result = run_tool({"track", "--source", "x.oni"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("--model"));
}

TEST(Usage, WhatWasMistypedIsNamedWithWhatWasMeant) {
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> mistakes = {
      {{"trakc", "--model", "cabinet"}, {"'trakc'", "did you mean track?"}},
      {{"track", "--modl", "cabinet", "--source", "x"}, {"--modl;", "did you mean --model?"}},
      {{"track", "--modl=cabinet", "--source", "x"}, {"--modl;", "did you mean --model?"}},
      {{"track", "--model", "cabinet", "--source", "x", "--snap", "y"},
       {"--snap;", "did you mean --snapshots?"}},
      {{"inspect", "cabinet"}, {"'cabinet'", "did you mean --model cabinet?"}},
      {{"inspect", "--model", "cabinet", "more"}, {"'more' belongs to no option"}},
      {{"experiment", "globl", "--output", "x"}, {"'globl'", "did you mean global?"}},
      {{"experiment", "global", "--outptu", "x"}, {"--outptu;", "did you mean --output?"}},
      {{"experiment", "global", "--output", "x", "--scense", "3"},
       {"--scense;", "did you mean --scenes?"}}};
  for (const auto& [arguments, words] : mistakes) {
    const auto result = run_tool(arguments);
    EXPECT_EQ(result.status, 2) << arguments[1];
    for (const auto& word : words) EXPECT_THAT(result.errors, HasSubstr(word));
  }
  EXPECT_THAT(run_tool({"track", "--qqqqqq"}).errors, testing::Not(HasSubstr("did you mean")));
}

/// Those of the library that reads options are for its programmers.
TEST(Usage, MessagesAreOurs) {
  const std::vector<std::string> track = {"track", "--model", "lockbox", "--source", "x.oni"};
  const std::vector<std::string> simulate = {"simulate", "-m", "rigid_block", "-t",
                                             "auto",     "-o", "out"};
  const auto errors_of = [](std::vector<std::string> arguments,
                            const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = run_tool(arguments);
    EXPECT_EQ(result.status, 2) << result.errors;
    return result.errors;
  };
  EXPECT_THAT(errors_of({"track"}, {"--model"}), HasSubstr("--model needs a value: --model FILE"));
  EXPECT_THAT(errors_of(track, {"--model", "x"}), HasSubstr("--model can be given only once"));
  EXPECT_THAT(errors_of(track, {"--collision", "of"}),
              HasSubstr("'of' is none of off, literal, eroded; did you mean off?"));
  EXPECT_THAT(errors_of(track, {"--quiet=maybe"}), HasSubstr("'maybe' is neither true nor false"));
  EXPECT_THAT(errors_of(simulate, {"--seed", "1.5"}), HasSubstr("--seed: '1.5' is not a whole"));
  EXPECT_THAT(errors_of(simulate, {"--bounds", "b.csv", "--deviation", "d.yaml"}),
              HasSubstr("--deviation and --bounds cannot be given together"));
  EXPECT_THAT(errors_of({"view", "--model", "lockbox"}, {"--size", "9x9"}),
              HasSubstr("'9' is not a number between 100 and 8192"));
}

TEST(Usage, FilesAreNotTakenForFolders) {
  const TemporaryFolder folder;
  for (const auto* name : {"x.bag", "x.mp4", "x.MCAP", "x.png", "x.ONI", "-"}) {
    const auto file = name == std::string("-") ? name : (folder / name).string();
    const auto simulated = run_tool({"simulate", "--model", "rigid_block", "--trajectory", "auto",
                                     "--frames", "2", "--output", file});
    EXPECT_EQ(simulated.status, 2) << name;
    EXPECT_THAT(simulated.errors, HasSubstr(name));
    const auto tracked =
        run_tool({"track", "--model", "rigid_block", "--source", "x.oni", "--output", file});
    EXPECT_EQ(tracked.status, 2) << name;
    const auto evaluated = run_tool(
        {"evaluate", "--estimate", "states.csv", "--reference", "truth.csv", "--output", file});
    EXPECT_EQ(evaluated.status, 2) << name;
    EXPECT_THAT(evaluated.errors, HasSubstr(name));
    EXPECT_FALSE(std::filesystem::exists(file));
  }
}

TEST(Usage, FilesThatAreWrittenHaveTheNameOfTheirKind) {
  const TemporaryFolder folder;
  for (const auto* name : {"-", "x", "x.jpg"}) {
    const auto file = name == std::string("-") ? name : (folder / name).string();
    const auto inspected = run_tool({"inspect", "--model", "rigid_block", "--picture", file});
    EXPECT_EQ(inspected.status, 2) << name;
    EXPECT_THAT(inspected.errors, HasSubstr(".png"));
    const auto simulated = run_tool({"simulate", "--model", "rigid_block", "--trajectory", "auto",
                                     "--output", folder / "o", "--bounds", file});
    EXPECT_EQ(simulated.status, 2) << name;
    EXPECT_THAT(simulated.errors, HasSubstr(".csv"));
    EXPECT_FALSE(std::filesystem::exists(file));
  }
}

TEST(Usage, MistypedNamesOfShippedFilesAreNamedWithTheNearest) {
  EXPECT_THAT(run_tool({"inspect", "--model", "rigid_blok"}).errors,
              HasSubstr("did you mean rigid_block?"));
  EXPECT_THAT(run_tool({"simulate", "--model", "rigid_block", "--trajectory", "auto", "--frames",
                        "1", "--output", "x", "--scene", "rom"})
                  .errors,
              HasSubstr("did you mean room?"));
}

TEST(Usage, OneIsNotMany) {
  EXPECT_THAT(run_tool({"inspect", "--model", "rigid_block"}).output,
              HasSubstr(": 1 body, 0 joints, 0 joint variables\n"));
}

TEST(Usage, ValuesOutOfRangeAreRefused) {
  const std::vector<std::vector<std::string>> wrong = {
      {"--iterations", "0"},   {"--threads", "-1"},      {"--iterations", "three"},
      {"--collision", "x"},    {"--max-frames", "-1"},   {"--record", "frames.png"},
      {"--depth-scale", "0"},  {"--depth-scale", "nan"}, {"--snapshot-interval", "0"},
      {"--max-frames", "1.5"}, {"--threads", "0.5"},     {"--point-budget", "1e30"}};
  for (const auto& option : wrong) {
    auto arguments = option;
    arguments.insert(arguments.begin(), {"track", "--model", "lockbox", "--source", "x.oni"});
    const auto result = run_tool(arguments);
    EXPECT_EQ(result.status, 2) << option[0];
    EXPECT_THAT(result.errors, HasSubstr(option[0]));
    EXPECT_THAT(result.errors, HasSubstr(option[1]));
    EXPECT_THAT(result.errors, testing::SizeIs(testing::Lt(120U))) << "is that readable?";
  }
}

TEST(Output, ThatIsLostIsAFailure) {
  Tool tool({"--help"}, {}, "/dev/full");
  const auto result = tool.wait();
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("standard output"));
}

TEST(Usage, UnknownAndMissingCommandsAreRefusedWithTheList) {
  for (const auto& arguments : std::vector<std::vector<std::string>>{{"trakc"}, {}}) {
    const auto result = run_tool(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.errors, HasSubstr("inspect"));
  }
}

}  // namespace
}  // namespace lockbox
