// SPDX-License-Identifier: BSD-3-Clause
#include "search_image.hpp"

#include <algorithm>

namespace lockbox {
namespace {

/// Objects, and the depths of the best sensors, are off by more than these err. Unit: 1/metre, a
/// PrimeSense's noise. Source: five of ten pieces of furniture that deviated by a third of
/// `mismatch` were not found by the noise of an ideal sensor, one is. Doubled, steps of a
/// centimetre are lost from 1.5 m on.
constexpr double kLeastNoise = 0.0021;
constexpr double kMedianNoise = 0.6;  // of the noise is left in a median of 4 x 4
constexpr double kHalfNoise = 0.85;   // of 2 x 2

}  // namespace

ViewNoise::ViewNoise(double depth_noise)
    : pixel(depth_noise),
      coarse(kMedianNoise * std::max(depth_noise, kLeastNoise)),
      fine(kHalfNoise * std::max(depth_noise, kLeastNoise)) {}

SearchImage::SearchImage(const SoughtModel& sought, const ViewNoise& noise,
                         const StopRequest& stop_request, const Executor& executor)
    : sought_(sought), noise_(noise), executor_(executor), surroundings_(sought.model.tree) {
  for (int worker = 0; worker < executor.threads(); ++worker) {
    coarse_.emplace_back(sought.from_afar, noise.coarse, stop_request);
    fine_.emplace_back(sought.from_afar, noise.fine, stop_request);
    parts_.emplace_back();
  }
}

void SearchImage::look_at(const TiledCloud& cloud) {
  cloud_ = &cloud;
  view_.emplace(cloud, kCoarseColumns, executor_);
  CloudOptions unfiltered;
  unfiltered.flying_pixel_jump = 0.0;
  coarse_cloud_.assign(view_->camera, view_->depth, unfiltered, executor_);
  for (ViewScore& score : coarse_) score.set_view(*view_);

  fine_view_.emplace(cloud, kFineColumns, executor_);
  for (ViewScore& score : fine_) score.set_view(*fine_view_);

  scene_.emplace(find_planes(*view_, noise_.coarse));
  surroundings_.set_scene(*scene_);
}

const TiledCloud& SearchImage::object(const Configuration& configuration) {
  return surroundings_.left_out_of(*cloud_, configuration, noise_.pixel, part_);
}

const TiledCloud& SearchImage::coarse_object(const Configuration& configuration) {
  return surroundings_.left_out_of(coarse_cloud_, configuration, noise_.coarse,
                                   parts_[Executor::worker()]);
}

double SearchImage::score(const Hypothesis& hypothesis, double slack, double tolerance,
                          bool is_close) {
  ViewScore& view = is_close ? fine_[Executor::worker()] : coarse_score();
  return view.evidence(hypothesis.configuration, slack, hypothesis.bodies).total(tolerance);
}

double SearchImage::score_closely(const Configuration& configuration, double slack) {
  return fine_[Executor::worker()].evidence(configuration, slack, sought_.all_bodies).total(0.0);
}

}  // namespace lockbox
