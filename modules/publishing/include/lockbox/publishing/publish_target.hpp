// SPDX-License-Identifier: BSD-3-Clause
// Where states are published while a run is under way.
#pragma once

#include <cstdint>
#include <string>

namespace lockbox {

/// Where states go.
struct PublishTarget {
  /// How they get there.
  enum class Kind { standard_output, tcp, unix_socket, udp };

  std::string text;                   ///< as it was given, for messages
  Kind kind = Kind::standard_output;  ///< which of the members below count
  std::string host;                   ///< of tcp: where to listen; of udp: where to send to
  std::uint16_t port = 0;             ///< likewise; 0 for tcp: one that is free
  std::string path;                   ///< of the Unix socket
};

/// Reads `stdout`, `tcp:PORT` (on 127.0.0.1), `tcp:HOST:PORT`, `unix:PATH` or `udp:HOST:PORT`; an
/// IPv6 address stands in brackets. Throws InputError that says what is wrong with the text.
PublishTarget parse_publish_target(const std::string& text);

}  // namespace lockbox
