// SPDX-License-Identifier: BSD-3-Clause
// The frame loop: predict, register, judge. Frames in, states out.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/depth_frame.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/tracking/motion_predictor.hpp"

namespace lockbox {

enum class TrackingStatus { initializing, tracking, uncertain, lost };

/// The word for a states file.
std::string to_string(TrackingStatus status);

struct TrackerOptions {
  RegistrationOptions registration;
  CloudOptions cloud;
  int threads = 0;  ///< 0: all cores

  /// The first frame: the base alone, from where its surfaces are this far off (metres), then the
  /// joints too, within a narrow gate: wide gates would turn and slide parts onto each other.
  double start_margin = 0.2;  ///< points farther from the expected object are left out, metres
  double start_spread = 0.04;
  int start_iterations = 30;
  double start_joint_spread = 0.005;
  int start_joint_iterations = 10;

  /// `tracking` needs at least these shares of the visible surface: explained of all of it, and of
  /// the part that is explained or contradicted.
  double least_explained = 0.15;
  double least_agreement = 0.85;
  double lost_agreement = 0.60;  ///< below it, or below half of least_explained: `lost`
};

struct TrackingResult {
  double stamp = 0.0;
  TrackingStatus status = TrackingStatus::initializing;
  Configuration configuration;
  Eigen::MatrixXd covariance;    ///< of (base twist (v, w) in the base's frame, joint variables)
  Eigen::VectorXd sigma;         ///< square roots of its diagonal
  std::vector<bool> observable;  ///< by unknown; a joint that is not keeps its last value
  double residual_rms = 0.0;     ///< whitened: 1 where the sensor errs as assumed
  double explained = 0.0;        ///< shares of the model's visible surface
  double contradicted = 0.0;
  double occluded = 0.0;
  double latency_ms = 0.0;
};

/// Not thread-safe; one object per camera. The model must outlive it.
class Tracker {
 public:
  Tracker(const ArticulatedModel& model, const TrackerOptions& options);

  /// Where to look in the next frame. Until it was called, process() reports `initializing`.
  void start(const Configuration& configuration);

  /// Valid until the next call. Throws InputError if the frame is not a depth image.
  const TrackingResult& process(const DepthFrame& frame);

  const TiledCloud& cloud() const { return cloud_; }
  const TrackerOptions& options() const { return options_; }
  const CollisionTerm& collision() const { return registration_.collision(); }

 private:
  void keep_object(const Configuration& start, double margin);
  const RegistrationResult& find_start(const DepthFrame& frame, const Configuration& start);
  void judge(const RegistrationResult& registered);

  const ArticulatedModel& model_;
  TrackerOptions options_;
  Executor executor_;
  TiledCloud cloud_;
  ArticulatedRegistration registration_;
  MotionPredictor predictor_;
  std::optional<Configuration> start_;
  TrackingResult result_;
};

}  // namespace lockbox
