// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>

#include "lockbox/cloud/cloud_options.hpp"
#include "lockbox/core/stop_request.hpp"
#include "lockbox/registration/registration_options.hpp"

namespace lockbox {

struct SensorProfile;

struct TrackerOptions {
  RegistrationOptions registration;
  CloudOptions cloud;
  int threads = 0;  ///< 0: all cores

  /// Around a guess: first as it is, within a narrow gate; then the base alone, from where its
  /// surfaces are start_spread off (metres), and the joints after it. Wide gates would turn and
  /// slide parts onto each other.
  double start_margin = 0.2;  ///< points farther from the expected object are left out, metres
  double start_spread = 0.04;
  int start_iterations = 30;
  double start_joint_spread = 0.005;
  int start_joint_iterations = 10;
  bool search_anywhere = true;  ///< where no guess helps, at the start and when lost
  /// Seconds that a search may take from one frame, at 1.5 for each of its rounds and at least one
  /// round: one that needs more goes on in later frames (docs/initialization.md). No clock decides
  /// it, so that a recording gives the same each time. Not in the background, where no frame waits.
  double search_limit = std::numeric_limits<double>::infinity();
  /// Frames do not wait for searches, which then go on in a thread of their own: for live sources.
  /// What a recording gives depends on the clock with it, and not without.
  bool background_search = false;
  /// Where the first search finds nothing and the frame does not tell why, other readings of it are
  /// tried (search_failure.hpp), which takes some seconds. Not in the background.
  bool try_other_readings = false;
  /// Among them depths in another unit: only where nobody has said which one it is.
  bool try_other_units = true;
  /// Ends searches, which may take a minute: process() then throws Stopped within some tenths of a
  /// second. Frames that need no search are not stopped.
  StopRequest stop_request = nullptr;

  /// The iterations of a frame are few because predictions are good. After one that was not,
  /// surfaces still move by more than noise moves them: then so many more follow, in as many
  /// rounds, until the last one of a round moves them by less than that (metres).
  double resting_move = 0.001;
  int further_iterations = 6;
  int most_rounds = 8;

  /// `tracking` needs at least these shares of the visible surface: explained of all of it, and of
  /// the part that is explained or contradicted; of each body, too, for or against which at least
  /// so many pixels speak. Right bodies reach 0.93.
  double least_explained = 0.15;
  double least_agreement = 0.9;
  double least_body_agreement = 0.75;
  double least_body_pixels = 80.0;
  double most_patches_behind = 0.03;  ///< of what speaks for or against a body: patches behind it
  double most_continued = 0.85;  ///< of the outline: there the scene goes on as the model's surface
  double most_last_move = 0.003;  ///< metres: surfaces that still move are not where they belong
  /// Metres, of the base's position as the frame tells it, what the object misfits included: the
  /// corner of a board in a wall fits. Half of what counts as right.
  double most_base_sigma = 0.01;
  /// Radians, of the way the base is turned, by noise alone: a degree. Doubled, what is turned by
  /// more than counts as right may be `tracking`; halved, more of what is small or far away is not.
  double most_base_turning_sigma = 0.0175;
  /// Metres, of Candidate::rival_distance: something else may be right as well.
  double most_rival_distance = 0.005;
  /// Metres and radians: of a joint whose standard deviation is larger, three of which are 1 cm and
  /// 5 degrees, the position is not reported as known.
  double most_sliding_sigma = 0.0033;
  double most_turning_sigma = 0.029;
  /// What is believed more than that is the object (lockbox/verification/belief.hpp): a part that
  /// contradicts the image is not known then, all else is; and what a search finds is kept even
  /// where it would drift off if gates were wider.
  double convincing_belief = 0.999;
  /// Two seconds; to ask the image takes as long as a frame. Doubled, belief lags twice as long
  /// behind what has become of the object while its status stays the same.
  int frames_between_beliefs = 60;
  std::size_t most_alternatives = 3;
  /// A joint that was sought over its whole range, while less than this share of what it moves is
  /// explained, is known only where so many pixels more (of JointMargins) speak for its position
  /// than for any other. Of five wrong joints in 1000 random scenes four were such, and one in
  /// ninety of the right ones.
  double least_of_sought_body = 0.5;
  double least_margin_of_hidden = 25.0;
  double lost_agreement = 0.60;  ///< below it, or below half of least_explained: `lost`
};

/// The noise, its correlation and the range of depths are the sensor's from now on.
void assume_sensor(const SensorProfile& sensor, TrackerOptions& options);

}  // namespace lockbox
