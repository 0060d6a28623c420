// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace lockbox {

/// A plain reader of a server, as any program has one.
class StreamClient {
 public:
  /// A TCP server on the loopback interface, that may not have begun yet.
  static StreamClient of_port(int port);
  static StreamClient of_path(const std::string& path);

  explicit StreamClient(int socket) : socket_(socket) {}
  ~StreamClient();
  StreamClient(StreamClient&& other) noexcept;
  StreamClient& operator=(StreamClient&&) = delete;

  bool is_connected() const { return socket_ >= 0; }

  /// Without its end; empty where the connection has ended. What comes after the last end of a line
  /// is in rest().
  std::string line();

  /// All that comes until the end of the connection.
  std::string all();

  const std::string& rest() const { return received_; }

  void say(const std::string& text) const;

 private:
  bool receive();

  int socket_;
  std::string received_;
};

}  // namespace lockbox
