// SPDX-License-Identifier: BSD-3-Clause
// The part of the model's surface that a configuration turns to the camera: a z-buffer of the
// model, as points fixed to their bodies.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/model_term.hpp"
#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox {

struct VisibleSample {
  Eigen::Vector3f p_body;
  int body;
  int u;  ///< where the view shows it
  int v;
};

/// Reuses its buffers; one sample for each pixel of the view that shows a body, that is for each
/// block of pixels_per_sample pixels of the camera.
class VisibleSurface {
 public:
  void render(const ArticulatedModel& model, const BodyPoses& T_camera_body,
              const PinholeCamera& camera, const Executor& executor);

  /// The point of a body that pixel (u, v) of the view shows; not for kNothing.
  VisibleSample sample(int u, int v) const;

  /// visible[i]: number of the body in the pixel of the cloud's point i; where there is none,
  /// kernels::label_beside. lateral: how many pixels noise may put a point beside the model; the
  /// rest of its distance from the outline adds to that in square.
  void label(const TiledCloud& cloud, double lateral, const Executor& executor,
             std::vector<float>& visible) const;

  /// Samples in the rows of the view before row v; v = height: all.
  std::size_t samples_before(int v) const { return row_begins_[static_cast<std::size_t>(v)]; }
  double pixels_per_sample() const { return static_cast<double>(reduction_) * reduction_; }

  /// The z-buffer, and how many pixels of the camera lie along each side of one of its own.
  const RenderedDepth& view() const { return image_; }
  const PinholeCamera& view_camera() const { return renderer_->camera(); }
  int reduction() const { return reduction_; }

  /// Where the bodies were when they were drawn.
  const BodyPoses& T_body_camera() const { return T_body_camera_; }

 private:
  void count_samples(const Executor& executor);
  void measure_outline_distance(const Executor& executor);

  PinholeCamera full_camera_;
  std::unique_ptr<DepthRenderer> renderer_;
  std::vector<RenderItem> items_;
  RenderedDepth image_;
  BodyPoses T_body_camera_;
  std::vector<std::size_t> row_begins_;         ///< samples before each row; the number of all
  std::vector<std::uint8_t> outline_distance_;  ///< pixels of the view, up to 255; 0 on the model
  int reduction_ = 1;
};

}  // namespace lockbox
