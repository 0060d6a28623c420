// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/visualization/captioned_picture.hpp"
#include "lockbox/visualization/model_painter.hpp"
#include "lockbox/visualization/shown_estimate.hpp"

namespace lockbox::app {

/// Pictures of the model over the depth image, one of every few frames, as PNG files. Lines below
/// say what is known of it, each with the colour of the body that it is about.
class Snapshots {
 public:
  static constexpr auto kFirst = "frame_000000.png";

  /// Returns the name of the picture of this frame.
  static std::string name_of(std::size_t frame);

  /// Makes the folder. The tree is referred to.
  Snapshots(const std::filesystem::path& folder, const KinematicTree& tree, std::size_t interval,
            const Executor& executor);

  /// Draws frame_000000.png and so on, numbered like the frames. title: the first line.
  void add(const DepthFrame& frame, const ShownEstimate& estimate, const std::string& title);

 private:
  std::filesystem::path folder_;
  const KinematicTree& tree_;
  std::size_t interval_;
  std::size_t count_ = 0;
  Executor executor_;
  CaptionRoom room_;
  PinholeCamera camera_;                 ///< of the last picture
  std::optional<ModelPainter> painter_;  ///< made for that camera
};

}  // namespace lockbox::app
