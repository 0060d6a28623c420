// SPDX-License-Identifier: BSD-3-Clause
#include "connection.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

namespace lockbox::virtual_depth {
namespace {

constexpr int kPatience = 5000;  // milliseconds for a producer that stalls within a message
constexpr std::uint32_t kMaximumSize = 4096;  // pixels

std::string problem_of(const VirtualDepthHeader& header) {
  const VirtualDepthHeader expected;
  if (std::memcmp(header.magic, expected.magic, sizeof(header.magic)) != 0 ||
      header.version != expected.version) {
    return "the producer speaks another protocol";
  }
  if (header.width == 0 || header.width > kMaximumSize || header.height == 0 ||
      header.height > kMaximumSize || (header.unit != 1000 && header.unit != 100)) {
    return "the producer's image size or unit is impossible";
  }
  return {};
}

}  // namespace

Connection::Connection(const std::string& uri) {
  const std::string address = uri.substr(sizeof(kVirtualDepthPrefix) - 1);
  if (address.rfind("fd:", 0) == 0) {
    socket_ = std::atoi(address.c_str() + 3);
  } else if (!connect(address)) {
    error_ = "nobody offers frames at " + address;
    return;
  }
  error_ = read(&header_, sizeof(header_))
               ? problem_of(header_)
               : "the producer at " + address + " sends nothing; does another program use it?";
}

Connection::~Connection() {
  if (socket_ >= 0) {
    ::close(socket_);
  }
}

bool Connection::connect(const std::string& address) {
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  if (address.size() >= sizeof(name.sun_path)) {
    return false;
  }
  std::memcpy(name.sun_path, address.c_str(), address.size());
  socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  return ::connect(socket_, reinterpret_cast<const sockaddr*>(&name), sizeof(name)) == 0;
}

std::size_t Connection::frame_bytes() const {
  return std::size_t{header_.width} * header_.height * sizeof(std::uint16_t);
}

Connection::Wait Connection::wait(int milliseconds) {
  pollfd descriptor{socket_, POLLIN, 0};
  if (::poll(&descriptor, 1, milliseconds) <= 0) {
    return Wait::nothing;
  }
  char first = 0;
  return ::recv(socket_, &first, 1, MSG_PEEK) == 1 ? Wait::ready : Wait::closed;
}

bool Connection::read_frame(std::uint64_t& timestamp, void* depth) {
  return read(&timestamp, sizeof(timestamp)) && read(depth, frame_bytes());
}

bool Connection::read(void* bytes, std::size_t size) {
  auto* to = static_cast<char*>(bytes);
  while (size > 0) {
    pollfd descriptor{socket_, POLLIN, 0};
    if (::poll(&descriptor, 1, kPatience) <= 0) {
      return false;
    }
    const ssize_t count = ::recv(socket_, to, size, 0);
    if (count <= 0) {
      return false;
    }
    to += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace lockbox::virtual_depth
