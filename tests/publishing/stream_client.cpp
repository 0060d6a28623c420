// SPDX-License-Identifier: BSD-3-Clause
#include "stream_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

namespace lockbox {
namespace {

/// -1 if nobody has listened for some seconds.
template <typename Address>
int connected(int family, const Address& address) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (std::chrono::steady_clock::now() < give_up) {
    const int result = ::socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (::connect(result, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) {
      return result;
    }
    ::close(result);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return -1;
}

}  // namespace

StreamClient StreamClient::of_port(int port) {
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return StreamClient(connected(AF_INET, address));
}

StreamClient StreamClient::of_path(const std::string& path) {
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
  return StreamClient(connected(AF_UNIX, address));
}

StreamClient::StreamClient(StreamClient&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), received_(std::move(other.received_)) {}

StreamClient::~StreamClient() {
  if (socket_ >= 0) ::close(socket_);
}

std::string StreamClient::line() {
  while (true) {
    const auto end = received_.find('\n');
    if (end != std::string::npos) {
      const std::string result = received_.substr(0, end);
      received_.erase(0, end + 1);
      return result;
    }
    if (!receive()) return "";
  }
}

std::string StreamClient::all() {
  while (receive()) {
  }
  return std::exchange(received_, "");
}

void StreamClient::say(const std::string& text) const {
  ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
}

bool StreamClient::receive() {
  std::array<char, 4096> text{};
  const auto count = ::recv(socket_, text.data(), text.size(), 0);
  if (count <= 0) return false;
  received_.append(text.data(), static_cast<std::size_t>(count));
  return true;
}

}  // namespace lockbox
