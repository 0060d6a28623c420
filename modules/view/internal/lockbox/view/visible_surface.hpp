// SPDX-License-Identifier: BSD-3-Clause
// The part of the model's surface that a configuration turns to the camera: a z-buffer of the
// model, as points fixed to their bodies.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lockbox/cloud/point_tiles.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/view/pixel_prediction.hpp"

namespace lockbox {

class ContinuedEdges;

/// Reuses its buffers.
class VisibleSurface {
 public:
  /// most_columns: of the view; its rays are those of every n-th pixel of the camera.
  void render(const ArticulatedModel& model, const BodyPoses& T_camera_body,
              const PinholeCamera& camera, int most_columns, const Executor& executor);

  /// The camera's pixel whose ray a pixel of the view has.
  Pixel camera_pixel(int u, int v) const {
    return {u * reduction_ + reduction_ / 2, v * reduction_ + reduction_ / 2};
  }

  /// What the view shows in the pixels of points, as the camera of render() measured them; far
  /// beside all bodies where the scene goes on beyond an edge.
  void predict(const PointTiles& points, const ContinuedEdges& continued, const Executor& executor,
               PixelPrediction& prediction) const;

  /// The pixel of the view that shows what a pixel of the camera would, by index.
  std::size_t view_pixel(std::size_t camera_pixel) const { return view_pixel_[camera_pixel]; }

  /// The z-buffer, and how many pixels of the camera lie along each side of one of its own.
  const RenderedDepth& view() const { return image_; }
  const PinholeCamera& view_camera() const { return renderer_->camera(); }
  int reduction() const { return reduction_; }

  /// Whether one surface goes on over a square of the view. Where it ends, a pixel is of what is
  /// before or of what is behind.
  bool goes_on(int u, int v, int size) const;

  /// Where the bodies were when they were drawn.
  const BodyPoses& T_body_camera() const { return T_body_camera_; }

 private:
  void find_view_pixels();
  void measure_contour_distance(const Executor& executor);
  void label_pixels(const Executor& executor);
  void label_row(int v);

  PinholeCamera full_camera_;
  std::vector<std::unique_ptr<DepthRenderer>> renderers_;  ///< by reduction
  DepthRenderer* renderer_ = nullptr;                      ///< that of the last view
  std::vector<RenderItem> items_;
  RenderedDepth image_;
  BodyPoses T_body_camera_;
  /// Pixels of the view, up to 255; 0 on the model. Only where the view is drawn.
  std::vector<std::uint8_t> contour_distance_;
  /// Number of the body, or -1 less the pixels of the view to the nearest that shows one.
  std::vector<std::int16_t> label_;
  int reduction_ = 1;
  std::vector<std::uint32_t> view_pixel_;  ///< by pixel of the camera
};

}  // namespace lockbox
