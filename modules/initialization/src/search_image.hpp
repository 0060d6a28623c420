// SPDX-License-Identifier: BSD-3-Clause
// The image that is searched, as the stages of a search look at it: whole, in two views of fewer
// pixels, and by its planes.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hypothesis.hpp"
#include "lockbox/core/stop_request.hpp"
#include "lockbox/verification/coarse_view.hpp"
#include "planar_regions.hpp"
#include "sought_model.hpp"
#include "surroundings.hpp"
#include "view_score.hpp"

namespace lockbox {

inline constexpr int kCoarseColumns = 160;  ///< of the view that hypotheses are scored in
inline constexpr int kFineColumns = 320;    ///< of the view that the best are compared in

/// What each kind of view has of the sensor's noise: standard deviations of 1/depth, 1/metre. Those
/// of the views hold what an object is off its model, too.
struct ViewNoise {
  explicit ViewNoise(double depth_noise);

  double pixel;   ///< of a pixel of the image
  double coarse;  ///< of a sample of the view of kCoarseColumns, a median of 4 x 4 pixels
  double fine;    ///< of kFineColumns, of 2 x 2
};

/// Workers of the executor may score at the same time. What is sought must outlive it.
class SearchImage {
 public:
  SearchImage(const SoughtModel& sought, const ViewNoise& noise, const StopRequest& stop_request,
              const Executor& executor);

  /// What follows is about this cloud, which is referred to until the next one.
  void look_at(const TiledCloud& cloud);

  const TiledCloud& cloud() const { return *cloud_; }
  const CoarseView& fine_view() const { return *fine_view_; }
  const ViewNoise& noise() const { return noise_; }
  const PlanarScene& scene() const { return *scene_; }
  /// The planes of the finer view, which hold smaller pieces.
  PlanarScene finer_scene() const { return find_planes(*fine_view_, noise_.fine); }

  /// The cloud without the planes that are mostly elsewhere than the model. Valid until the next
  /// call of it.
  const TiledCloud& object(const Configuration& configuration);
  /// Returns the same of the coarse view, for each worker.
  const TiledCloud& coarse_object(const Configuration& configuration);

  /// What the bodies explain that the hypothesis knows of, in the coarse view or the finer one.
  /// slack: metres that surfaces may be off. tolerance: of what speaks against it.
  double score(const Hypothesis& hypothesis, double slack, double tolerance, bool is_close);
  /// What the whole model explains in the finer view, which shows more of what the camera saw
  /// through.
  double score_closely(const Configuration& configuration, double slack);

  /// The worker's drawing in the coarse view.
  ViewScore& coarse_score() { return coarse_[Executor::worker()]; }
  /// Returns the scores of all workers in the finer view.
  std::span<ViewScore> fine_scores() { return fine_; }

 private:
  const SoughtModel& sought_;
  ViewNoise noise_;
  Executor executor_;
  const TiledCloud* cloud_ = nullptr;
  std::optional<CoarseView> view_;
  std::optional<CoarseView> fine_view_;
  std::optional<PlanarScene> scene_;
  TiledCloud coarse_cloud_;
  Surroundings surroundings_;
  /// By worker.
  std::vector<ViewScore> coarse_;
  std::vector<ViewScore> fine_;
  std::vector<PartOfCloud> parts_;
  PartOfCloud part_;
};

}  // namespace lockbox
