// SPDX-License-Identifier: BSD-3-Clause
// What a configuration shows the camera, and where the image is looked at for it.
#pragma once

#include <cstddef>

#include "lockbox/cloud/image_points.hpp"
#include "lockbox/cloud/thinned_points.hpp"
#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/solver/motion_metric.hpp"
#include "lockbox/view/block_averages.hpp"
#include "lockbox/view/continued_edges.hpp"
#include "lockbox/view/contour_points.hpp"
#include "lockbox/view/pixel_prediction.hpp"
#include "lockbox/view/sampling_plan.hpp"
#include "lockbox/view/view_detail.hpp"
#include "lockbox/view/view_options.hpp"
#include "lockbox/view/view_samples.hpp"
#include "lockbox/view/visible_surface.hpp"

namespace lockbox {

/// Reuses its buffers.
class PredictedView {
 public:
  /// point_budget: points of a cloud that it chooses, about; 0: all of them.
  PredictedView(std::size_t point_budget, const ViewDetail& detail)
      : point_budget_(point_budget), detail_(detail) {}

  /// Draws the model, and chooses points of the cloud. What lies farther beside the model than
  /// reach (metres) is something else: the wall that it hangs on, the table that it stands on.
  /// is_predicted: points may be averaged. The cloud must outlive the view.
  void look_at(const TiledCloud& cloud, const ArticulatedModel& model,
               const Configuration& configuration, double reach, bool is_predicted,
               const ViewOptions& options, const Executor& executor);

  /// Until it looks again, it shows nothing.
  void forget() { is_drawn_ = false; }

  /// Whether the model would still look like this.
  bool shows(const Configuration& configuration, const MotionMetric& moves) const;

  /// Returns the points of the cloud that were chosen.
  const PointTiles& points() const { return *points_; }
  /// Whether their tiles are not those of the image.
  bool has_own_tiles() const { return points_ == &thinned_ || points_ == &averages_; }
  const PixelPrediction& prediction() const { return prediction_; }  ///< of the points
  const VisibleSurface& surface() const { return surface_; }
  /// Where the scene goes on beyond the surface's edges.
  const ContinuedEdges& continued() const { return continued_; }
  const ViewSamples& samples() const { return samples_; }      ///< of the surface
  const ContourPoints& contours() const { return contours_; }  ///< of the surface

 private:
  void gather(const TiledCloud& cloud, const ArticulatedModel& model, bool is_averaged,
              const ViewOptions& options, const Executor& executor);

  std::size_t point_budget_;
  ViewDetail detail_;
  bool is_drawn_ = false;
  Configuration configuration_;  ///< as it was drawn
  VisibleSurface surface_;
  ViewEdges view_edges_;
  ContinuedEdges continued_;
  SamplingPlan plan_;
  ViewSamples samples_;
  ContourPoints contours_;
  ImagePoints all_;
  ThinnedPoints thinned_;
  BlockAverages averages_;
  const PointTiles* points_ = nullptr;
  PixelPrediction prediction_;
  BodyPoses poses_;
};

}  // namespace lockbox
