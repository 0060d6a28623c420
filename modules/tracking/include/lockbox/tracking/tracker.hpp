// SPDX-License-Identifier: BSD-3-Clause
// The frame loop: predict, register, classify. Frames in, states out.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/model/configuration.hpp"
#include "lockbox/tracking/tracker_options.hpp"
#include "lockbox/tracking/tracking_status.hpp"

namespace lockbox {

struct ArticulatedModel;
struct SearchFailure;
class TiledCloud;

/// Where the object may be as well, as far as the frame tells.
struct Alternative {
  /// What differs from the reported answer.
  enum class Kind {
    flip,       ///< in the same place, turned
    elsewhere,  ///< in another place
  };

  Kind kind;                    ///< what differs from the reported answer
  Configuration configuration;  ///< the other answer
  double probability;           ///< in [0, 1], that it is the right one
};

/// Returns the word for it in a states file.
std::string to_string(Alternative::Kind kind);

/// How large the object looks, as a multiple of its model: across the optical axis, at the distance
/// that is measured, and along it (its relief); docs/mathematics-uncertainty.md, "Does the size
/// fit?". Until that was measured the covariance is infinite.
struct ApparentSize {
  Eigen::Vector2d value = Eigen::Vector2d::Ones();  ///< (across, along)
  /// The covariance of value.
  Eigen::Matrix2d covariance =
      std::numeric_limits<double>::infinity() * Eigen::Matrix2d::Identity();

  /// Returns whether `across` is off, beyond doubt, by more than objects differ from their drawings
  /// and cameras from their calibrations: 3 %. Such an object is `uncertain` at best.
  bool is_implausible() const;
  /// Returns whether that may be the scale of the model, or of the depths: no image tells these
  /// apart.
  bool may_be_scale() const;
  /// Returns whether it may be the focal length. Where there is too little relief to tell, both may
  /// be.
  bool may_be_focal_length() const;
};

/// How long something took, milliseconds.
struct Elapsed {
  double wall_ms = 0.0;  ///< by the clock
  double cpu_ms = 0.0;   ///< of the calling thread alone: the same however busy the machine is
};

/// What is known of the object in one frame.
struct TrackingResult {
  /// What shares and residuals are without an object.
  static constexpr double kNothingFound = std::numeric_limits<double>::quiet_NaN();

  double stamp = 0.0;                                    ///< seconds, the frame's
  TrackingStatus status = TrackingStatus::initializing;  ///< what is known
  /// Where the object is; NaN while nothing is known.
  Configuration configuration;
  Eigen::MatrixXd covariance;    ///< of (base twist (v, w) in the base's frame, joint variables)
  Eigen::VectorXd sigma;         ///< square roots of its diagonal
  std::vector<bool> observable;  ///< by unknown; a joint that is not keeps its last value
  /// How what is reported fits the frame; NaN while nothing is found.
  double residual_rms = kNothingFound;  ///< whitened: 1 where the sensor errs as assumed
  double explained = kNothingFound;     ///< shares of the model's visible surface
  double contradicted = kNothingFound;  ///< seen through, or measured behind
  double occluded = kNothingFound;      ///< something else in front
  /// The probability that the base is where it is reported (docs/verification.md); 0 while nothing
  /// is found. The image is asked for it at the start, where the status changes, and every
  /// TrackerOptions::frames_between_beliefs.
  double belief = 0.0;
  /// What the search could not tell from it, the most probable first, at most
  /// TrackerOptions::most_alternatives; empty where a search could, or none was made.
  std::vector<Alternative> alternatives;
  ApparentSize size;   ///< over the last measurements
  int searches = 0;    ///< how often the object was sought in the whole frame, up to now
  Elapsed cloud_time;  ///< from depth to cloud
  Elapsed step_time;   ///< all else: prediction, registration, classification, searches if need be
  double latency_ms = 0.0;  ///< milliseconds by the clock, from depth to result
};

/// Follows the object from frame to frame. It is not thread-safe; each camera needs one of its own.
/// The model must outlive it.
class Tracker {
 public:
  /// Throws InputError if the model's file asks for an erosion that a body is too thin for.
  Tracker(const ArticulatedModel& model, const TrackerOptions& options);
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  /// Says where to look in the next frame. Without it the object is sought everywhere, and
  /// process() reports `initializing` until it was found.
  void start(const Configuration& configuration);

  /// Tells what is known of the object in this frame. An image that is shown again says nothing
  /// new, for its errors are the same: once what was found in it has come to rest, it stays. Valid
  /// until the next call. Throws InputError if the frame is not a depth image, and Stopped if a
  /// search was asked to stop (TrackerOptions::stop_request); the frame then counts as not seen.
  const TrackingResult& process(const DepthFrame& frame);

  /// Says why the last search of the whole frame found nothing to believe in; nothing if it did, or
  /// if none was made yet.
  const std::optional<SearchFailure>& search_failure() const;

  const TiledCloud& cloud() const;  ///< of the frame that was processed last
  /// Returns the options in force.
  const TrackerOptions& options() const;

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace lockbox
