// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/publishing/publish_target.hpp"

#include <sys/un.h>

#include <charconv>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

using Kind = PublishTarget::Kind;

constexpr auto kKnownTargets =
    "targets are stdout, tcp:PORT, tcp:HOST:PORT, unix:PATH and udp:HOST:PORT";

[[noreturn]] void refuse(const PublishTarget& target, const std::string& problem) {
  throw InputError(in_quotes(target.text), problem + "; " + kKnownTargets);
}

void read_port(const std::string& text, PublishTarget& target) {
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, target.port);
  if (text.empty() || error != std::errc() || rest != end) {
    refuse(target, in_quotes(text) + " is not a port, a whole number from 0 to 65535");
  }
  if (target.port == 0 && target.kind == Kind::udp) refuse(target, "nobody receives at port 0");
}

void read_address(const std::string& address, PublishTarget& target) {
  const auto colon = address.rfind(':');
  if (colon == std::string::npos) {
    if (target.kind == Kind::udp) refuse(target, "a host and a port are needed");
    target.host = "127.0.0.1";
    read_port(address, target);
    return;
  }
  target.host = address.substr(0, colon);
  const bool is_bracketed = target.host.starts_with('[') && target.host.ends_with(']');
  if (is_bracketed) target.host = target.host.substr(1, target.host.size() - 2);
  if (target.host.empty()) refuse(target, "the host is missing");
  if (!is_bracketed && target.host.find(':') != std::string::npos) {
    refuse(target, "an IPv6 address stands in brackets, as in tcp:[::1]:5555");
  }
  read_port(address.substr(colon + 1), target);
}

void read_path(const std::string& path, PublishTarget& target) {
  constexpr std::size_t kLongest = sizeof(sockaddr_un::sun_path) - 1;
  target.path = path;
  if (path.empty()) refuse(target, "the path is missing");
  if (path.size() > kLongest) {
    refuse(target, "paths of Unix sockets have at most " + std::to_string(kLongest) +
                       " characters, this one has " + std::to_string(path.size()));
  }
}

}  // namespace

PublishTarget parse_publish_target(const std::string& text) {
  PublishTarget target;
  target.text = text;
  const auto rest = [&](std::string_view scheme) { return text.substr(scheme.size()); };
  if (text == "stdout") {
    target.kind = Kind::standard_output;
  } else if (text.starts_with("tcp:")) {
    target.kind = Kind::tcp;
    read_address(rest("tcp:"), target);
  } else if (text.starts_with("udp:")) {
    target.kind = Kind::udp;
    read_address(rest("udp:"), target);
  } else if (text.starts_with("unix:")) {
    target.kind = Kind::unix_socket;
    read_path(rest("unix:"), target);
  } else {
    refuse(target, "is not known");
  }
  return target;
}

}  // namespace lockbox
