// SPDX-License-Identifier: BSD-3-Clause
// Writes genuine .oni recordings: OpenNI2's own recorder, fed by the virtual device driver.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "lockbox/capture/frame_source.hpp"
#include "lockbox/core/depth_frame.hpp"

namespace lockbox {

/// OpenNI2 records in a helper process (lockbox-oni-recorder), because its recorder keeps state in
/// static variables and a core busy, and because the calling program may have loaded an OpenNI2
/// that does not know the virtual driver. If the calling program dies, the helper still finishes
/// the recording of all frames written until then. A recording grows in a file of its own, the
/// name with `.part` behind it, and replaces what had the name when it is complete.
///
/// Depths come back bit for bit, but for what OpenNI2's encoder cannot hold: 65535 becomes 0 ("no
/// measurement"), and where the last row ends with three equal pixels and a different one, that
/// last pixel takes their value. Stamps come back in microseconds from the first. Focal lengths
/// come back exactly if they have at most four decimals, else to 1e-4 pixels.
class OniWriter {
 public:
  /// Throws std::filesystem::filesystem_error if there is no folder for temporary files, which
  /// finish() needs. Throws InputError if the file cannot be written, or is not a regular one, if
  /// another recorder is at it, in this process or another, or if OpenNI2 cannot describe the
  /// camera (the principal point must be the middle of the image, the unit 1 mm or 0.1 mm). From:
  /// the file of the first frame, for messages.
  OniWriter(const std::filesystem::path& file, const PinholeCamera& camera, int frames_per_second,
            float metres_per_unit = 0.001F, const std::string& from = {});

  /// Closes the file. Without finish(), it is completed but not verified.
  ~OniWriter();

  /// Writes one frame. Stamps must increase, camera and unit stay what they were; else this throws
  /// InputError, and the recording holds the frames before. Throws DeviceError if the disk is full:
  /// the recording is then complete, but for the latest frames. From: the file of the frame, for
  /// messages.
  void write(const DepthFrame& frame, const std::string& from = {});

  /// Completes the file, replays it, and compares every frame with what was written. Throws
  /// DeviceError if they differ, InputError if no frame was written.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes the frames that next_frame delivers until it returns false; returns their number.
std::size_t write_oni(const std::filesystem::path& file, const PinholeCamera& camera,
                      int frames_per_second, const std::function<bool(DepthFrame&)>& next_frame);

/// When record() ends, if the source does not end before.
struct RecordingEnd {
  /// It ends when this returns true: asked every 50 ms of a device, and after each frame of a
  /// recording.
  std::function<bool()> stop;
  /// It ends after so many seconds, of a device by the clock, of a recording by its stamps.
  double seconds = std::numeric_limits<double>::infinity();
};

/// Records the depth of a live device (`openni2:` or `openni2:<uri>`) as it comes, or that of a
/// recording of any kind, from its beginning, opened with these options, of which only the mode
/// holds for a device. Returns the number of frames, which is 1 at least. Throws InputError or
/// DeviceError; the latter, with the recording complete, if the disk is full.
std::size_t record(const std::string& source, const std::filesystem::path& file,
                   const RecordingEnd& end, const SourceOptions& options = {});

}  // namespace lockbox
