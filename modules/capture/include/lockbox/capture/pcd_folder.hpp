// SPDX-License-Identifier: BSD-3-Clause
// Sequences of organized point clouds in .pcd files. PCL's writer and compression are in a
// component of their own, loaded when they are asked for: they bring all of VTK.
#pragma once

#include <filesystem>
#include <memory>

#include "lockbox/capture/frame_source.hpp"

namespace lockbox {

/// Delivers the clouds of a folder, in natural order of their names, as depth images. Intrinsics
/// are recovered from the first cloud that tells them, by least squares, unless options give them.
/// Depths that are whole millimetres stay so; others are rounded to the finest of 0.1, 0.25 and 1
/// mm that reaches the farthest point. If all names hold stamps (docs/recordings.md), these are
/// the frames' times and their order; else frames are 1/30 s apart. A cloud that cannot be used,
/// one of another size, too, becomes a frame without any depth, told to options.warn and counted.
class PcdFolderSource : public FrameSource {
 public:
  /// Throws InputError if there are no clouds, none of the first 300 can be used, their camera can
  /// not be recovered, or they are not in metres (nor in options.depth_scale).
  explicit PcdFolderSource(const std::filesystem::path& folder, const SourceOptions& options = {});
  ~PcdFolderSource() override;

  bool next(DepthFrame& frame) override;
  std::optional<std::size_t> frame_count() const override;
  /// Returns what was mended or left out so far.
  SourceFaults faults() const override;
  std::string file_of_frame() const override;
  bool is_unit_stated() const override;
  /// Returns the folder, and the scale in force.
  std::string description() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes what PcdFolderSource reads: organized, compressed clouds, named after their stamps.
class PcdFolderWriter {
 public:
  /// Creates the folder. Throws InputError if it holds clouds already or cannot be written.
  explicit PcdFolderWriter(const std::filesystem::path& folder);

  /// Writes one frame. Stamps must not be negative; they are kept in microseconds.
  void write(const DepthFrame& frame) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace lockbox
