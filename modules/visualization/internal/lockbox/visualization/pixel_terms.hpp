// SPDX-License-Identifier: BSD-3-Clause
// Which term of the registration (docs/mathematics.md) a measurement enters, as far as the place of
// the model tells.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox {

/// Metres to both sides of the surface within which a measurement counts as one of it: four
/// standard deviations of a PrimeSense-class sensor at 1.2 m, the gate of the point term. Doubled,
/// more of the background counts.
inline constexpr float kTermReach = 0.01F;

enum class PixelTerm : std::uint8_t {
  none,        ///< not of the model
  points,      ///< on its surface: E_model
  edges,       ///< on its surface, beside an edge of it: the likelihood of the image, too
  free_space,  ///< behind it, where the model should hide it: E_free
  hidden       ///< before it: something stands there, and the model is free
};

class PixelTerms {
 public:
  /// The model is referred to, not copied.
  explicit PixelTerms(const ArticulatedModel& model);

  /// Finds the term of each pixel with a measurement, row by row, with the bodies at these poses.
  void find(const DepthFrame& frame, const std::vector<Eigen::Isometry3d>& T_camera_body,
            std::vector<PixelTerm>& terms);

 private:
  PixelTerm of_pixel(const DepthFrame& frame, int u, int v, bool is_near) const;
  bool is_edge(int u, int v) const;

  const ArticulatedModel& model_;
  std::vector<RenderItem> items_;
  std::optional<DepthRenderer> renderer_;  ///< made for the camera of the last frame
  RenderedDepth rendered_;
  std::vector<Eigen::Vector3f> points_;
  std::vector<float> distances_;
};

}  // namespace lockbox
