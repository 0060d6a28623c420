// SPDX-License-Identifier: BSD-3-Clause
// `track --publish`, read by real sockets and pipes.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <future>
#include <nlohmann/json.hpp>
#include <sstream>

#include "block_runs.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/states_file.hpp"
#include "publishing/stream_client.hpp"

namespace lockbox {
namespace {

using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::SizeIs;

std::vector<json> states_in(const std::string& text) {
  std::vector<json> states;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) states.push_back(json::parse(line));
  return states;
}

/// A socket, and the port of this machine that the system gave it.
std::pair<int, int> bound_socket() {
  const int bound = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  EXPECT_EQ(bind(bound, reinterpret_cast<const sockaddr*>(&address), size), 0);
  getsockname(bound, reinterpret_cast<sockaddr*>(&address), &size);
  return {bound, ntohs(address.sin_port)};
}

/// One that nobody uses, most probably: the system hands them out in turn.
int free_port() {
  const auto [bound, port] = bound_socket();
  close(bound);
  return port;
}

class Publish : public BlockRuns {
 protected:
  static Tool publishing(const std::string& run, const std::vector<std::string>& targets,
                         const std::filesystem::path& output = {}) {
    std::vector<std::string> more;
    for (const auto& target : targets) more.insert(more.end(), {"--publish", target});
    return Tool(following(run, more), {}, output);
  }

  static std::vector<std::string> without_output(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "track", "--model", "rigid_block", "--source", path("block"), "--initial-state", start_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  /// Every row of the run is a line, of the same numbers.
  static void expect_same(const std::vector<json>& lines, const std::string& run) {
    const auto tree = load_kinematic_tree(LOCKBOX_MODELS "/rigid_block/rigid_block.urdf");
    const auto rows = read_states(path(run + "/states.csv"), tree).states;
    ASSERT_EQ(lines.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(lines[i]["frame"], i);
      EXPECT_EQ(lines[i]["header"]["stamp"], rows[i].stamp);
      EXPECT_EQ(lines[i]["status"], rows[i].status);
      const auto& position = lines[i]["pose"]["pose"]["position"];
      const Eigen::Vector3d p(position["x"], position["y"], position["z"]);
      EXPECT_EQ(p, rows[i].configuration.T_camera_base.translation());
      EXPECT_GE(lines[i]["pose"]["pose"]["orientation"]["w"], 0.0) << "as in states.csv";
      EXPECT_THAT(lines[i]["pose"]["covariance"], SizeIs(36));
    }
  }
};

TEST_F(Publish, GivesNothingButLinesToStandardOutput) {
  const auto result = publishing("stdout", {"stdout"}).wait();
  ASSERT_EQ(result.status, 0) << result.errors;
  expect_same(states_in(result.output), "stdout");
  EXPECT_THAT(result.errors, HasSubstr("\n30 frames, "));
}

TEST_F(Publish, GivesTheSameToAllReadersOfAllTargets) {
  const int port = free_port();
  const std::string socket = path("socket");
  std::vector<std::future<std::string>> readers;
  for (int i = 0; i < 2; ++i) {
    readers.push_back(
        std::async(std::launch::async, [=] { return StreamClient::of_port(port).all(); }));
    readers.push_back(
        std::async(std::launch::async, [=] { return StreamClient::of_path(socket).all(); }));
  }
  const auto result =
      publishing("several", {"tcp:" + std::to_string(port), "unix:" + socket}).wait();
  ASSERT_EQ(result.status, 0) << result.errors;
  for (auto& reader : readers) expect_same(states_in(reader.get()), "several");
  EXPECT_THAT(result.errors, HasSubstr("publishing: tcp 127.0.0.1:" + std::to_string(port)));
  EXPECT_THAT(read_text(path("several/run.yaml")),
              ContainsRegex("published:\n +- .*tcp:[0-9]+\"?, readers: 2, dropped: 0, "
                            "address: \"?tcp 127.0.0.1:[0-9]+\"?}\n +- .*unix"));
  EXPECT_FALSE(std::filesystem::exists(socket));
}

TEST_F(Publish, DoesNotCareForReadersThatDoNotReadOrGoAway) {
  const std::string socket = path("careless");
  auto idle = std::async(std::launch::async, [=] { return StreamClient::of_path(socket); });
  auto leaving =
      std::async(std::launch::async, [=] { return StreamClient::of_path(socket).line(); });
  const auto result = publishing("careless_run", {"unix:" + socket}).wait();
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(leaving.get(), HasSubstr("\"frame\":0,"));
  ASSERT_EQ(run_tool(following("alone")).status, 0);
  EXPECT_EQ(rows_without_latency(path("careless_run/states.csv")),
            rows_without_latency(path("alone/states.csv")));
  EXPECT_TRUE(idle.get().is_connected());
}

TEST_F(Publish, GoesOnWhenTheReaderOfStandardOutputGoesAwayOrStops) {
  const auto pipe = path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  Tool left = publishing("left", {"stdout"}, pipe);
  close(reader);
  const auto left_alone = left.wait();
  EXPECT_EQ(left_alone.status, 0);
  EXPECT_THAT(left_alone.errors, HasSubstr("nobody reads standard output any more"));
  EXPECT_THAT(read_text(path("left/run.yaml")), HasSubstr("dropped: 30,")) << "no line was read";
  EXPECT_THAT(read_lines(path("left/states.csv")), SizeIs(kFrames + 1));

  reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(fcntl(reader, F_SETPIPE_SZ, 4096), 4096);
  EXPECT_EQ(publishing("full", {"stdout"}, pipe).wait().status, 0);
  EXPECT_THAT(read_lines(path("full/states.csv")), SizeIs(kFrames + 1));
  EXPECT_THAT(read_text(path("full/run.yaml")), ContainsRegex("target: stdout.*dropped: [1-9]"));
  close(reader);
}

TEST_F(Publish, EndsTheRunWhenNobodyReadsItsOnlyOutput) {
  const auto pipe = path("only_pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  Tool tool(without_output({"--publish", "stdout"}), {}, pipe);
  close(reader);
  EXPECT_EQ(tool.wait().status, 128 + SIGPIPE);
}

TEST_F(Publish, FailsWhereStandardOutputCannotBeWritten) {
  for (const bool has_files : {true, false}) {
    auto arguments = has_files ? following("no_space") : without_output({});
    arguments.insert(arguments.end(), {"--publish", "stdout"});
    const auto result = Tool(arguments, {}, "/dev/full").wait();
    EXPECT_EQ(result.status, 3);
    EXPECT_THAT(result.errors, HasSubstr("standard output: cannot be written (No space left"));
  }
  EXPECT_THAT(read_text(path("no_space/run.yaml")), HasSubstr("error: standard output"));
}

TEST_F(Publish, IsRefusedBeforeAnythingIsDone) {
  const auto [taken, number] = bound_socket();
  ASSERT_EQ(listen(taken, 1), 0);
  const auto port = std::to_string(number);
  const auto in_use = publishing("refused", {"tcp:" + port}).wait();
  EXPECT_EQ(in_use.status, 3);
  EXPECT_THAT(in_use.errors, HasSubstr("another program uses port " + port));
  close(taken);
  const auto malformed = publishing("refused", {"tcp:port"}).wait();
  EXPECT_EQ(malformed.status, 2);
  EXPECT_THAT(malformed.errors, HasSubstr("'port' is not a port"));
  EXPECT_FALSE(std::filesystem::exists(path("refused")));
}

TEST_F(Publish, EndsInTimeAtASignalWhereNobodyReads) {
  const std::string socket = path("ended");
  auto idle = std::async(std::launch::async, [=] { return StreamClient::of_path(socket); });
  Tool tool(following("ended_run", {"--realtime", "--publish", "unix:" + socket}));
  wait_for_rows("ended_run", 3);
  const auto signalled = std::chrono::steady_clock::now();
  tool.send_signal(SIGINT);
  EXPECT_EQ(tool.wait().status, 128 + SIGINT);
  EXPECT_LT(std::chrono::steady_clock::now() - signalled, std::chrono::seconds(2));
  EXPECT_FALSE(std::filesystem::exists(socket));
  EXPECT_TRUE(idle.get().is_connected());
}

}  // namespace
}  // namespace lockbox
