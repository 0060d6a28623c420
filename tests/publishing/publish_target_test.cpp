// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/publishing/publish_target.hpp"

#include <gmock/gmock.h>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

using Kind = PublishTarget::Kind;

TEST(PublishTarget, ListensOnTheLoopbackInterfaceUnlessAHostIsGiven) {
  const auto loopback = parse_publish_target("tcp:5555");
  EXPECT_EQ(loopback.kind, Kind::tcp);
  EXPECT_EQ(loopback.host, "127.0.0.1");
  EXPECT_EQ(loopback.port, 5555);
  EXPECT_EQ(parse_publish_target("tcp:0.0.0.0:5555").host, "0.0.0.0");
  EXPECT_EQ(parse_publish_target("tcp:[::1]:5555").host, "::1");
  EXPECT_EQ(parse_publish_target("stdout").kind, Kind::standard_output);
  EXPECT_EQ(parse_publish_target("unix:/run/a:b").path, "/run/a:b");
  const auto udp = parse_publish_target("udp:robot.local:65535");
  EXPECT_EQ(udp.kind, Kind::udp);
  EXPECT_EQ(udp.host, "robot.local");
  EXPECT_EQ(udp.port, 65535);
}

TEST(PublishTarget, IsRefusedWithWhatIsWrongAndWhatThereIs) {
  for (const std::string text :
       {"", "std", "tcp", "tcp:", "tcp:a", "tcp:-1", "tcp:65536", "tcp:5555 ", "tcp::5555",
        "tcp:::1:5555", "tcp:host:", "udp:5555", "udp:host:0", "unix:", "http://localhost:80"}) {
    try {
      parse_publish_target(text);
      ADD_FAILURE() << text << " was taken";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("'" + text + "'"));
      EXPECT_THAT(error.what(), testing::HasSubstr("tcp:HOST:PORT"));
    }
  }
  EXPECT_THROW(parse_publish_target("unix:/" + std::string(107, 'x')), InputError);
  EXPECT_NO_THROW(parse_publish_target("unix:/" + std::string(106, 'x')));
}

}  // namespace
}  // namespace lockbox
