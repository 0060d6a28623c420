// SPDX-License-Identifier: BSD-3-Clause
// Sequences of organized point clouds in .pcd files. PCL's reader and writer are in a component of
// their own, loaded when they are asked for: they bring all of VTK.
#pragma once

#include <filesystem>
#include <memory>

#include "lockbox/capture/frame_source.hpp"

namespace lockbox {

/// Delivers the clouds of a folder, in name order, as depth images. Intrinsics are recovered from
/// the first cloud by least squares unless options give them. Depths that are whole millimetres
/// stay so; others are rounded to the finest of 0.1, 0.25 and 1 mm that reaches the farthest point.
/// Stamps come from the names if all hold one (docs/file-formats.md), else are 1/30 s apart.
class PcdFolderSource : public FrameSource {
 public:
  /// Throws InputError if there are no clouds, or their camera can not be recovered, or if
  /// the component is not installed.
  explicit PcdFolderSource(const std::filesystem::path& folder, const SourceOptions& options = {});
  ~PcdFolderSource() override;

  /// Throws InputError for a damaged cloud or one that is not organized.
  bool next(DepthFrame& frame) override;
  std::optional<std::size_t> frame_count() const override;
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

  /// Stamps must not be negative; they are kept in microseconds.
  void write(const DepthFrame& frame) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace lockbox
