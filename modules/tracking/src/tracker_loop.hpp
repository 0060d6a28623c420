// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/tracking/acquisition.hpp"
#include "lockbox/tracking/background_search.hpp"
#include "lockbox/tracking/classification.hpp"
#include "lockbox/tracking/motion_predictor.hpp"
#include "lockbox/tracking/size_record.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "lockbox/verification/verifier.hpp"

namespace lockbox {

/// What the tracker does, and all that it remembers from frame to frame.
class Tracker::Loop {
 public:
  Loop(const ArticulatedModel& model, const TrackerOptions& options);

  // As in Tracker.
  void start(const Configuration& configuration);
  const TrackingResult& process(const DepthFrame& frame);
  const std::optional<SearchFailure>& search_failure() const;
  const TiledCloud& cloud() const { return cloud_; }
  const TrackerOptions& options() const { return options_; }

 private:
  bool is_known() const;
  bool shows_nothing_new(const DepthFrame& frame);
  void search(const DepthFrame& frame);
  std::optional<Answer> sought(const DepthFrame& frame, SearchScope scope);
  std::optional<Answer> sought_in_background(const DepthFrame& frame, SearchScope scope,
                                             bool is_due);
  std::optional<Answer> brought_up_to_date(const Answer& answer);
  std::optional<Answer> where_it_was();
  void stop_searching();
  void follow(const DepthFrame& frame);
  /// A joint that comes back into sight is sought until then.
  static constexpr int kFramesToKnowMotion = 2;
  void measure_size(const Answer& found);
  void count_frames_in_sight(const Answer& found);
  Configuration with_hidden_joints_sought(const Configuration& prediction);
  Answer come_to_rest(const Configuration& prediction, const Answer& registered);
  AlignOptions further() const;
  bool is_on_its_way(const Configuration& start, const Answer& result) const;
  bool is_hidden_at_once(const Answer& registered) const;
  bool has_leapt(const Answer& registered) const;
  bool needs_no_search(const Answer& registered) const;
  bool is_flush(const Answer& found, int variable) const;
  Answer with_leap_followed(const DepthFrame& frame, const Configuration& prediction,
                            const Answer& registered);
  Answer with_rival_sought(const DepthFrame& frame, const Answer& followed);
  bool is_doubted_as_before(const Answer& registered) const;
  Answer with_doubts_kept(const Configuration& prediction, const Answer& registered);
  void verify(Answer& found);
  void carry_parts(const Configuration& prediction, Answer& best);
  void seek_contradicted_joints(Answer& best);
  void report(const Answer& registered);
  void report_belief(const Answer& registered, TrackingStatus before);
  double belief_by_image(const Configuration& configuration);
  void report_status();
  void report_nothing();
  void forget();

  const ArticulatedModel& model_;
  TrackerOptions options_;
  Executor executor_;
  TiledCloud cloud_;
  ArticulatedRegistration registration_;
  Acquisition acquisition_;
  MotionPredictor predictor_;
  Verifier verifier_;
  SizeRecord size_record_;
  TrackingStatus status_ = TrackingStatus::initializing;  ///< by all but the apparent size
  std::optional<Configuration> guess_;
  /// The estimate was tracked, or given, and nothing has contradicted it since. Then it is followed
  /// even where the image does not determine it, and not sought elsewhere.
  bool is_kept_ = false;
  std::vector<std::uint16_t> last_depth_;  ///< the image that was processed last
  PinholeCamera last_camera_;
  float last_unit_ = 0.0F;
  int repeats_ = 0;          ///< of that image, in a row, since the object was found in it
  int frames_searched_ = 0;  ///< since the object was last tracked, or the view is another
  std::ptrdiff_t measured_before_ = 0;  ///< pixels, when that view was first searched
  std::vector<int> sought_joints_;      ///< variables to be sought over their whole range
  JointMargins hidden_margins_;         ///< of those that were sought since they were hidden
  double rival_distance_ = 0.0;         ///< of what was last reported: until a search tells
  double base_turning_sigma_ = 0.0;     ///< likewise
  double belief_ = 0.0;                 ///< of what was last reported, where it was asked for
  std::vector<int> doubted_;            ///< bodies that contradicted that, in order
  int frames_doubted_ = 0;              ///< since the image was asked
  int frames_without_belief_ = 0;       ///< since it was asked for the belief that is reported
  std::vector<int> frames_in_sight_;    ///< by variable: consecutive, up to the present
  /// By variable: in view, but flush with what is around it, so that seeking would find nothing.
  std::vector<bool> is_flush_;
  TrackingResult result_;
  std::unique_ptr<BackgroundSearch> background_;  ///< made when it is first needed
  bool is_found_anew_ = false;  ///< what is reported is a search's answer, not what was followed
  int answers_passed_ = 0;      ///< of it, in a row: right in their frames, not in the newest
};

}  // namespace lockbox
