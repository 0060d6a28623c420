// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/predicted_view.hpp"

#include <algorithm>

#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

/// Metres that surfaces may move before they are drawn again: in a view of every pixel, and at
/// most.
constexpr double kStaleView = 0.002;
constexpr double kMostStaleView = 0.008;
/// From a prediction: pixels of the view between samples of the surface, and blocks of pixels that
/// are averaged, at least, if points have a budget. Closer and smaller ones tell the same.
constexpr int kLeastSpacing = 2;
constexpr std::size_t kViewSamples = 20000;  // of the visible surface, where points have no budget

}  // namespace

void PredictedView::look_at(const TiledCloud& cloud, const ArticulatedModel& model,
                            const Configuration& configuration, double reach, bool is_predicted,
                            const ViewOptions& options, const Executor& executor) {
  is_drawn_ = true;
  configuration_ = configuration;
  if (!cloud.has_image()) {
    continued_.clear();
    points_ = &cloud.blocks();
    prediction_.body.assign(points_->x().size(), kernels::label_beside(0.0F));
    prediction_.depth.assign(points_->x().size(), 0.0F);
    return;
  }
  forward_kinematics(model.tree, configuration, poses_);
  const bool is_thinned = point_budget_ > 0;
  const int columns = view_columns(detail_.rays, model, poses_, cloud.camera());
  surface_.render(model, poses_, cloud.camera(), columns, executor);
  view_edges_.find(surface_.view(), executor);
  continued_.find(model, surface_, view_edges_, cloud, reach, options, executor);
  plan_.plan(surface_.view(), view_edges_, surface_.reduction(), surface_.view_camera().fx, reach,
             is_thinned ? point_budget_ : kViewSamples, executor);
  const bool is_averaged = is_predicted && !cloud.is_masked();
  gather(cloud, model, is_averaged, options, executor);
  if (is_averaged) {
    points_ = &averages_;
  } else if (is_thinned) {
    thinned_.assign(cloud, plan_.density());
    points_ = &thinned_;
  } else {
    all_.assign(cloud, executor);
    points_ = &all_;
  }
  surface_.predict(*points_, continued_, executor, prediction_);
}

/// What is taken from the view, at once: samples, contours, and points if they are averaged.
void PredictedView::gather(const TiledCloud& cloud, const ArticulatedModel& model, bool is_averaged,
                           const ViewOptions& options, const Executor& executor) {
  samples_.choose(surface_, plan_.density(), is_averaged ? kLeastSpacing : 1, executor);
  const ContourPoints::Scene contours{
      model, surface_, view_edges_, continued_, detail_.contour_spacing, options};
  const BlockAverages::Scene blocks{cloud, surface_, plan_.density(),
                                    point_budget_ > 0 ? kLeastSpacing : 1, options};
  contours_.begin(surface_.view());
  averages_.begin(plan_.density());
  executor.for_each({{contours_.bands(), [&](std::size_t i) { contours_.find_band(contours, i); }},
                     {is_averaged ? averages_.bands() : 0,
                      [&](std::size_t i) { averages_.fill_band(blocks, i); }},
                     {samples_.rows(), [&](std::size_t i) { samples_.place_row(surface_, i); }}});
  samples_.finish();
  if (is_averaged) averages_.finish();
}

bool PredictedView::shows(const Configuration& configuration, const MotionMetric& moves) const {
  if (!is_drawn_) return false;
  const double stale = std::min(kStaleView * surface_.reduction(), kMostStaleView);
  return moves.between(configuration_, configuration) <= stale;
}

}  // namespace lockbox
