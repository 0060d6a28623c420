// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/configuration.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/visualization/rgb_image.hpp"

namespace lockbox {

/// How a model is painted in which nothing has a colour, as in bare meshes.
enum class GreyModel {
  as_it_is,
  in_orange  ///< so that it stands out from what is grey behind it
};

/// Draws a model in its own colours, shaded by its surface's normals, with dark contours. Works
/// without a display.
class ModelPainter {
 public:
  /// Prepares to draw the tree, which is referred to, not copied.
  ModelPainter(const KinematicTree& tree, const PinholeCamera& camera, const Executor& executor,
               GreyModel grey = GreyModel::as_it_is);

  /// Returns red, green and blue in [0, 1] of the first shape of each body, before it is shaded;
  /// none where a body has no shape.
  std::vector<std::optional<Eigen::Vector3f>> body_colors() const;

  /// Paints over the image (of the camera's size); opacity 1 hides what was there.
  void paint(const Configuration& configuration, float opacity, RgbImage& image);

 private:
  void place_items(const Configuration& configuration);
  Eigen::Vector3f color_of_sample(int u, int v) const;

  const KinematicTree& tree_;
  DepthRenderer renderer_;
  std::vector<RenderItem> items_;
  std::vector<int> body_of_item_;
  std::vector<Eigen::Vector3f> color_of_item_;  ///< red, green, blue in [0, 1]
  std::vector<Eigen::Isometry3d> T_camera_body_;
  RenderedDepth rendered_;
};

}  // namespace lockbox
