// SPDX-License-Identifier: BSD-3-Clause
// The depth stream of the virtual device.
#pragma once

// Debian ships OniDriverAPI.h without the platform header that defines these.
#define FALSE 0
#define TRUE 1
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)
#include <Driver/OniDriverAPI.h>

#include <atomic>
#include <functional>
#include <thread>

#include "connection.hpp"

namespace lockbox::virtual_depth {

/// Raises each frame the moment it arrives.
class Stream : public oni::driver::StreamBase {
 public:
  /// on_end is called, from the stream's thread, when the producer is gone.
  Stream(Connection& connection, std::function<void()> on_end);
  ~Stream() override;

  OniStatus start() override;
  void stop() override;
  int getRequiredFrameSize() override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override;

 private:
  void run();
  bool raise_next();

  Connection& connection_;
  std::function<void()> on_end_;
  std::thread thread_;
  std::atomic<bool> running_{false};
  std::atomic<int> limit_;
  int frame_index_ = 0;
};

OniVideoMode video_mode_of(const VirtualDepthHeader& header);

}  // namespace lockbox::virtual_depth
