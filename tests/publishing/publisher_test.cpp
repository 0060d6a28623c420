// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/publishing/publisher.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "lockbox/core/error.hpp"
#include "publishing/stream_client.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

std::vector<PublishTarget> targets(const std::vector<std::string>& texts) {
  std::vector<PublishTarget> result;
  result.reserve(texts.size());
  for (const auto& text : texts) result.push_back(parse_publish_target(text));
  return result;
}

int port_of(const std::string& address) {
  return std::stoi(address.substr(address.rfind(':') + 1));
}

/// Connections are taken by another thread.
void wait_for_readers(const Publisher& publisher, std::size_t count) {
  for (int i = 0; i < 2000 && publisher.publications().front().readers < count; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

std::string problem(const std::vector<std::string>& texts) {
  try {
    Publisher publisher(targets(texts));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Binds a Unix socket; closing it leaves its name, as the end of a program by force does.
int bound_socket(const std::string& path) {
  const int result = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
  EXPECT_EQ(bind(result, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  return result;
}

TEST(Publisher, GivesEveryReaderEachLineFromThenOn) {
  const TemporaryFolder folder;
  Publisher publisher(targets({"tcp:0", "unix:" + (folder / "socket").string()}));
  EXPECT_THAT(publisher.addresses().front(), HasSubstr("tcp 127.0.0.1:"));
  StreamClient first = StreamClient::of_port(port_of(publisher.addresses().front()));
  wait_for_readers(publisher, 1);
  publisher.publish("one");
  EXPECT_EQ(first.line(), "one");
  StreamClient second = StreamClient::of_port(port_of(publisher.addresses().front()));
  StreamClient third = StreamClient::of_path((folder / "socket").string());
  wait_for_readers(publisher, 2);
  while (publisher.publications().back().readers < 1) std::this_thread::yield();
  publisher.publish("two");
  publisher.publish("three");
  publisher.close();
  EXPECT_EQ(first.all(), "two\nthree\n");
  EXPECT_EQ(second.all(), "two\nthree\n");
  EXPECT_EQ(third.all(), "two\nthree\n");
  const auto published = publisher.publications();
  EXPECT_EQ(published[0].address, publisher.addresses()[0]);
  EXPECT_EQ(published[0].readers, 2);
  EXPECT_EQ(published[1].readers, 1);
  EXPECT_EQ(published[0].dropped + published[1].dropped, 0);
  EXPECT_FALSE(std::filesystem::exists((folder / "socket"))) << "the socket is left";
}

TEST(Publisher, DropsTheOldestLinesOfAReaderThatDoesNotReadAndCountsThem) {
  Publisher publisher(targets({"tcp:0"}));
  const int port = port_of(publisher.addresses().front());
  StreamClient idle = StreamClient::of_port(port);
  StreamClient busy = StreamClient::of_port(port);
  wait_for_readers(publisher, 2);
  constexpr int kLines = 2000;
  const std::string filling(20000, 'x');  // 40 MB: more than any buffer of the system
  std::string last;
  std::size_t read = 0;
  std::thread reading([&] {
    for (std::string line = busy.line(); !line.empty(); line = busy.line()) {
      ++read;
      last = line;
    }
  });
  const auto begin = Clock::now();
  for (int i = 0; i < kLines; ++i) publisher.publish(std::to_string(i) + filling);
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(5)) << "it has waited";
  publisher.close();
  reading.join();
  const auto last_line = std::to_string(kLines - 1) + filling;
  EXPECT_TRUE(last == last_line) << "who reads has not got the newest line";
  const std::string idle_text = idle.all();
  const auto whole = static_cast<std::size_t>(std::count(idle_text.begin(), idle_text.end(), '\n'));
  EXPECT_LT(whole, kLines / 2);
  EXPECT_EQ(publisher.publications().front().dropped, 2 * kLines - whole - read);
}

TEST(Publisher, GoesOnWhenAReaderGoesAwayOrTalks) {
  Publisher publisher(targets({"tcp:0"}));
  const int port = port_of(publisher.addresses().front());
  StreamClient stays = StreamClient::of_port(port);
  {
    const StreamClient leaves = StreamClient::of_port(port);
    wait_for_readers(publisher, 2);
    publisher.publish("0");
  }
  stays.say(std::string(100000, '?'));
  std::string expected = "0\n";
  for (int i = 1; i < 50; ++i) {
    publisher.publish(std::to_string(i));
    expected += std::to_string(i) + "\n";
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  publisher.close();
  EXPECT_EQ(stays.all(), expected);
  EXPECT_EQ(publisher.publications().front().dropped, 0);
}

TEST(Publisher, EndsAtOnceWhereNobodyIsBehind) {
  Publisher publisher(targets({"tcp:0", "udp:127.0.0.1:9"}));
  const StreamClient reader = StreamClient::of_port(port_of(publisher.addresses().front()));
  wait_for_readers(publisher, 1);
  publisher.publish("one");
  const auto begin = Clock::now();
  publisher.close();
  EXPECT_LT(Clock::now() - begin, std::chrono::milliseconds(400));
}

TEST(Publisher, SendsADatagramForEachLineWhetherOrNotSomebodyReceivesIt) {
  const int receiver = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(bind(receiver, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  socklen_t size = sizeof(address);
  getsockname(receiver, reinterpret_cast<sockaddr*>(&address), &size);
  Publisher publisher(targets({"udp:127.0.0.1:" + std::to_string(ntohs(address.sin_port))}));
  publisher.publish("one");
  publisher.publish("two");
  publisher.publish(std::string(70000, 'x'));  // larger than datagrams can be
  std::string text(100, ' ');
  EXPECT_EQ(recv(receiver, text.data(), text.size(), 0), 4);
  EXPECT_TRUE(text.starts_with("one\n"));
  EXPECT_EQ(recv(receiver, text.data(), text.size(), 0), 4);
  EXPECT_TRUE(text.starts_with("two\n"));
  close(receiver);
  for (int i = 0; i < 3; ++i) publisher.publish("nobody");
  publisher.close();
  EXPECT_GE(publisher.publications().front().dropped, 1);
}

TEST(Publisher, NamesAPortThatIsInUseAndAHostThatIsNotThere) {
  const Publisher publisher(targets({"tcp:0"}));
  const auto port = std::to_string(port_of(publisher.addresses().front()));
  EXPECT_THAT(problem({"tcp:" + port}), HasSubstr("another program uses port " + port));
  EXPECT_THAT(problem({"tcp:192.0.2.1:5555"}), HasSubstr("tcp:192.0.2.1:5555: cannot be"));
  EXPECT_THAT(problem({"udp:no.such.host.invalid:5555"}), HasSubstr("host cannot be found"));
  EXPECT_THAT(problem({"stdout", "stdout"}), HasSubstr("given twice"));
}

TEST(Publisher, RefusesAStandardOutputThatIsClosed) {
  std::fflush(stdout);
  const int kept = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  close(STDOUT_FILENO);
  const std::string text = problem({"stdout"});
  dup2(kept, STDOUT_FILENO);
  close(kept);
  EXPECT_THAT(text, HasSubstr("standard output is closed"));
}

TEST(Publisher, ReplacesAUnixSocketOnlyIfNobodyListensThere) {
  const TemporaryFolder folder;
  const auto path = (folder / "socket").string();
  const int listening = bound_socket(path);
  ASSERT_EQ(listen(listening, 1), 0);
  EXPECT_THAT(problem({"unix:" + path}), HasSubstr("another program listens there; end it"));
  close(listening);
  ASSERT_TRUE(std::filesystem::exists(path));
  EXPECT_EQ(problem({"unix:" + path}), "") << "nobody listens";
  std::ofstream(path) << "precious";
  EXPECT_THAT(problem({"unix:" + path}), HasSubstr("no socket"));
  EXPECT_EQ(std::filesystem::file_size(path), 8);
  EXPECT_THAT(problem({"unix:" + (folder / "none/socket").string()}),
              HasSubstr("No such file or directory"));
}

TEST(Publisher, LeavesASocketThatHasTakenThePlaceOfItsOwn) {
  const TemporaryFolder folder;
  const auto path = (folder / "socket").string();
  {
    Publisher publisher(targets({"unix:" + path}));
    std::filesystem::remove(path);
    close(bound_socket(path));
  }
  EXPECT_TRUE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace lockbox
