// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lockbox/model/states_file.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/simulation/placed_scene.hpp"

namespace lockbox {

/// Shares of the model's surface that faces the camera.
struct ModelVisibility {
  double cut = 0.0;     ///< outside the image
  double hidden = 0.0;  ///< of what is in the image: behind the scene
};

/// Measures by drawing the model, alone and in its scene, into an image of twice the width and
/// height. What is not even in that counts as if it were not there; a model of which nothing is in
/// it is cut off completely. Reusable buffers; the tree must outlive it.
class VisibilityMeter {
 public:
  VisibilityMeter(const KinematicTree& tree, const PinholeCamera& camera, PlacedScene scene,
                  const Executor& executor);

  ModelVisibility measure(const State& state);

 private:
  const KinematicTree& tree_;
  PlacedScene scene_;
  DepthRenderer renderer_;
  ImageWindow image_;  ///< that of the camera in the larger one
  std::vector<Eigen::Isometry3d> T_camera_body_;
  std::vector<RenderItem> items_;
  RenderedDepth drawn_;
};

}  // namespace lockbox
