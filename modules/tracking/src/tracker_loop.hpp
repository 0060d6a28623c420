// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "followed_noise.hpp"
#include "frame_alignment.hpp"
#include "image_belief.hpp"
#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/tracking/acquisition.hpp"
#include "lockbox/tracking/joint_sight.hpp"
#include "lockbox/tracking/motion_predictor.hpp"
#include "lockbox/tracking/repeated_image.hpp"
#include "lockbox/tracking/size_record.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "object_search.hpp"
#include "rival_comparison.hpp"
#include "state_report.hpp"
#include "verdict.hpp"

namespace lockbox {

/// The states of the tracker, and what is tried in each, in which order. What is known is followed
/// (`tracking`, `uncertain`); what is not is searched for (`initializing`, `lost`).
class Tracker::Loop {
 public:
  Loop(const ArticulatedModel& model, const TrackerOptions& options);

  // As in Tracker.
  void start(const Configuration& configuration);
  const TrackingResult& process(const DepthFrame& frame);
  const std::optional<SearchFailure>& search_failure() const { return search_.failure(); }
  const TiledCloud& cloud() const { return cloud_; }
  const TrackerOptions& options() const { return options_; }

 private:
  /// An answer to follow from, and whether it is a search's, not what was followed.
  struct Followed {
    Answer answer;
    bool is_found_anew = false;
  };

  void follow_noise(const DepthFrame& frame);
  void follow(const DepthFrame& frame);
  void search(const DepthFrame& frame);
  SoughtJoints with_hidden_joints_sought(const Configuration& prediction);
  bool is_doubted_as_before(const Answer& registered) const;
  Answer with_doubts_kept(Answer followed);
  bool is_hidden_at_once(const Answer& registered) const;
  bool has_leapt(const Answer& registered) const;
  Followed with_leap_followed(const DepthFrame& frame, const Configuration& prediction,
                              const Answer& registered, FrameAlignment& alignment);
  Followed with_rival_sought(const DepthFrame& frame, const Followed& followed);
  /// What a search has found is compared from now on with what it could not tell from it.
  void begin_comparison(Answer& found);
  void seek_contradicted_joints(Answer& best);
  void verify(Answer& found);
  void report(Answer& answer);
  void measure_size(const Answer& found);

  const ArticulatedModel& model_;
  TrackerOptions options_;
  Executor executor_;
  TiledCloud cloud_;
  ArticulatedRegistration registration_;
  Acquisition acquisition_;
  ObjectSearch search_;
  ImageBelief image_belief_;
  RivalComparison rivals_;
  StateReport report_;
  MotionPredictor predictor_;
  JointSight joint_sight_;
  RepeatedImage repeated_image_;
  SizeRecord size_record_;
  FollowedNoise noise_;
  bool is_noise_known_ = false;  ///< by the images
  Verdict verdict_;              ///< of what was last reported
  /// The estimate was tracked, or given, and nothing has contradicted it since. Then it is followed
  /// even where the image does not determine it, and not sought elsewhere.
  bool is_kept_ = false;
  int frames_doubted_ = 0;  ///< in which bodies contradicted the image, since the image was asked
};

}  // namespace lockbox
