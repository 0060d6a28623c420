// SPDX-License-Identifier: BSD-3-Clause
// Live depth cameras through OpenNI2.
#pragma once

#include "lockbox/capture/frame_source.hpp"

namespace lockbox {

/// Delivers the newest frame, as a whole image if the device crops it; a slow consumer misses
/// frames, which shows as gaps in the index, and is counted.
class LiveDevice : public FrameSource {
 public:
  /// Opens the device with this URI, or the first one if it is empty, un-mirrored and in
  /// options.mode, or as near to 640x480, 30 Hz, 1 mm as it can. Throws DeviceError, also if it
  /// does not offer that mode.
  explicit LiveDevice(const std::string& uri, const SourceOptions& options = {});
  ~LiveDevice() override;

  /// Waits for a frame; false if it was told to stop. A device that is unplugged or silent is
  /// waited for, options.patience at most: options.warn is told so, and when it is back. Numbers of
  /// frames go on then, and stamps increase by the time that has passed if its clock begins anew.
  /// Throws DeviceError if it does not come back, InputError if it does with another image size.
  bool next(DepthFrame& frame) override;
  std::optional<std::size_t> frame_count() const override { return std::nullopt; }
  bool is_realtime() const override { return true; }
  /// Returns what was mended or left out so far.
  SourceFaults faults() const override;
  /// Returns the device, its URI and the mode it delivers in.
  std::string description() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lockbox
