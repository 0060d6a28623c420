// SPDX-License-Identifier: BSD-3-Clause
// Depth image sequences in the layout of the TUM RGB-D data sets: depth.txt with
// "timestamp filename" lines, 16-bit grey PNG images, and camera_info.yaml beside it.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>

#include "lockbox/capture/frame_source.hpp"

namespace lockbox {

/// An image that cannot be used (missing, damaged, of another size) becomes a frame without any
/// depth, told to options.warn and counted.
class DepthFolderSource : public FrameSource {
 public:
  /// Throws InputError, with file and line, also if none of the first 300 images can be used.
  explicit DepthFolderSource(const std::filesystem::path& folder,
                             const SourceOptions& options = {});
  ~DepthFolderSource() override;

  bool next(DepthFrame& frame) override;
  std::optional<std::size_t> frame_count() const override;
  /// Returns what was mended or left out so far.
  SourceFaults faults() const override;
  std::string file_of_frame() const override;
  bool is_unit_stated() const override;
  std::string description() const override;  ///< says the depth scale in force

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes what DepthFolderSource reads; each frame is on disk when write() returns.
class DepthFolderWriter {
 public:
  /// Creates the folder. Throws InputError if it holds a sequence already or cannot be written.
  explicit DepthFolderWriter(const std::filesystem::path& folder);

  /// Writes one frame. All frames must have the camera and the unit of the first.
  void write(const DepthFrame& frame);

 private:
  void begin(const DepthFrame& first);

  std::filesystem::path folder_;
  std::ofstream index_;
  DepthFrame first_;  ///< without its depth
  std::size_t count_ = 0;
};

}  // namespace lockbox
