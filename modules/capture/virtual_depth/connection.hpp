// SPDX-License-Identifier: BSD-3-Clause
// The driver's end of the socket to a producer of depth frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lockbox/capture/virtual_depth_protocol.hpp"

namespace lockbox::virtual_depth {

class Connection {
 public:
  /// Connects to the producer that the URI names and reads its header; is_open() says whether that
  /// worked, error() why not.
  explicit Connection(const std::string& uri);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  bool is_open() const { return error_.empty(); }
  const std::string& error() const { return error_; }
  const VirtualDepthHeader& header() const { return header_; }

  /// One at least, the first that of the header.
  const std::vector<VirtualDepthMode>& modes() const { return modes_; }

  /// Tells the producer in which of its modes frames are wanted. Only the first call counts.
  void choose(std::size_t mode);

  bool is_chosen() const { return is_chosen_; }
  std::size_t frame_bytes() const;

  enum class Wait { ready, nothing, closed };

  /// Waits up to milliseconds for the next frame to begin.
  Wait wait(int milliseconds);

  /// Reads one frame. False: the producer is gone.
  bool read_frame(std::uint64_t& timestamp, void* depth);

 private:
  bool connect(const std::string& address);
  bool read(void* bytes, std::size_t size);
  std::string read_header();

  int socket_ = -1;
  VirtualDepthHeader header_;
  std::vector<VirtualDepthMode> modes_;
  std::size_t mode_ = 0;  ///< that was chosen
  bool is_chosen_ = false;
  std::string error_;
};

}  // namespace lockbox::virtual_depth
