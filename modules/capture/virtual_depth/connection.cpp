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
constexpr std::uint32_t kMostModes = 64;
constexpr std::uint32_t kSeveralModes = 2;  // the version that has them

std::string problem_of(const VirtualDepthHeader& header) {
  const VirtualDepthHeader expected;
  if (std::memcmp(header.magic, expected.magic, sizeof(header.magic)) != 0 ||
      header.version < expected.version || header.version > kSeveralModes) {
    return "the producer speaks another protocol";
  }
  return {};
}

std::string problem_of(const VirtualDepthMode& mode) {
  if (mode.width == 0 || mode.width > kMaximumSize || mode.height == 0 ||
      mode.height > kMaximumSize || (mode.unit != 1000 && mode.unit != 100)) {
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
               ? read_header()
               : "the producer at " + address + " sends nothing; does another program use it?";
}

/// What follows the header, too. Returns what is wrong.
std::string Connection::read_header() {
  if (const std::string problem = problem_of(header_); !problem.empty()) return problem;
  modes_ = {{header_.width, header_.height, header_.frames_per_second, header_.unit}};
  std::uint32_t more = 0;
  if (header_.version == kSeveralModes && !read(&more, sizeof(more))) more = kMostModes;
  if (more >= kMostModes) return "the producer's modes are impossible";
  modes_.resize(1 + more);
  if (more > 0 && !read(&modes_[1], more * sizeof(VirtualDepthMode))) {
    return "the producer's modes are impossible";
  }
  for (const auto& mode : modes_) {
    if (const std::string problem = problem_of(mode); !problem.empty()) return problem;
  }
  return {};
}

void Connection::choose(std::size_t mode) {
  if (is_chosen_) return;
  is_chosen_ = true;
  mode_ = mode;
  if (header_.version != kSeveralModes) return;
  const auto number = static_cast<std::uint32_t>(mode);
  ::send(socket_, &number, sizeof(number), MSG_NOSIGNAL);  // if it is gone, the feed notices
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
  return std::size_t{modes_[mode_].width} * modes_[mode_].height * sizeof(std::uint16_t);
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
