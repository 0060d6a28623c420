// SPDX-License-Identifier: BSD-3-Clause
// Where depth frames come from: a live device, a recording, a folder.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lockbox/core/depth_frame.hpp"

namespace lockbox {

/// What a source had to mend or to leave out in the frames delivered so far.
struct SourceFaults {
  std::size_t unreadable = 0;  ///< file missing, damaged, of another size: came without any depth
  std::size_t restamped = 0;   ///< stamp not later than that of the frame before: was advanced
  std::size_t dropped = 0;     ///< came while the consumer was busy, in real time
  std::size_t outages = 0;     ///< times that a device was unplugged or silent, and came back
};

/// Delivers frames one after the other, on demand. Not thread-safe.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// Fills frame (its buffer is reused) and returns true, or returns false at the end.
  /// A live source waits for the next frame, but no longer than SourceOptions::stop wants; then it
  /// returns false, too. Throws DeviceError or InputError.
  virtual bool next(DepthFrame& frame) = 0;

  /// Returns the number of frames of a recording; nothing for a live source.
  virtual std::optional<std::size_t> frame_count() const = 0;

  /// Returns whether frames come when their time has come, and those not taken by then are dropped.
  virtual bool is_realtime() const { return false; }

  /// Returns whether somebody has said in which unit depths are: the recording, its calibration, or
  /// the user. Else the usual one was assumed.
  virtual bool is_unit_stated() const { return true; }

  /// Returns what was mended or left out in the frames delivered so far.
  virtual SourceFaults faults() const { return {}; }

  /// Returns the file that the frame delivered last is from, its own or that of the whole
  /// recording, for messages. It is empty for a device.
  virtual std::string file_of_frame() const { return {}; }

  /// Says what the source is, and which settings are in force, for people.
  virtual std::string description() const = 0;
};

/// A mode of a live camera's depth images.
struct DepthMode {
  int width = 0;                   ///< pixels
  int height = 0;                  ///< pixels
  int frames_per_second = 0;       ///< nominal
  double metres_per_unit = 0.001;  ///< 0.001 or 0.0001
  bool operator==(const DepthMode&) const = default;
};

/// The mode that a live camera is to deliver.
struct WantedMode {
  int width = 0;                          ///< pixels
  int height = 0;                         ///< pixels
  int frames_per_second = 0;              ///< nominal
  std::optional<double> metres_per_unit;  ///< 0.001 or 0.0001; nothing: the former where there is
                                          ///< a choice
};

/// How a source is opened and played. What does not concern its kind is not used.
struct SourceOptions {
  std::optional<PinholeCamera> camera;               ///< overrides the source's own intrinsics
  std::optional<std::filesystem::path> camera_info;  ///< ROS camera calibration YAML
  std::optional<double> depth_scale;                 ///< units per metre, folders
  std::optional<WantedMode> mode;  ///< of a live device; nothing: nearest to 640x480, 30 Hz, 1 mm
  bool realtime = false;           ///< play recordings at recorded speed
  double patience = 5.0;  ///< seconds that next() waits for a live device that is away or silent
  std::function<void(const std::string&)> warn;  ///< told what looks wrong but is usable
  /// Asked again and again, every half a second at least, while next() waits for a device or for
  /// the time of a frame. True ends the wait.
  std::function<bool()> stop;
};

/// Throws InputError if the source is a file or a folder that is not there.
void require_source(const std::string& source);

/// Opens `openni2:`, `openni2:<uri>`, a .oni file, a folder with depth.txt, or a folder of .pcd.
/// The stamps of frames increase: one that is not later than the last, or is no number, is advanced
/// to the last plus the frame period (at least 1 us), told once to options.warn, and counted.
std::unique_ptr<FrameSource> open_source(const std::string& source,
                                         const SourceOptions& options = {});

}  // namespace lockbox
