// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>

#include "lockbox/cloud/cloud_options.hpp"
#include "lockbox/core/stop_request.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/verification/evidence_options.hpp"

namespace lockbox {

struct SensorProfile;

/// All that a tracker goes by; defaults are those of `lockbox track`.
struct TrackerOptions {
  RegistrationOptions registration;  ///< of every alignment
  CloudOptions cloud;                ///< which measurements are used
  EvidenceOptions evidence;          ///< by which answers are compared and believed
  /// Threads of the tracker. 0: all cores. Unit: threads. Source: the user's, `--threads`.
  int threads = 0;

  // Around a guess: first as it is, within a narrow gate; then the base alone, from where its
  // surfaces are start_sigma off, and the joints after it. Wide gates would turn and slide parts
  // onto each other.

  /// Points farther from the expected object are left out while the base is found: table and walls.
  /// Unit: metres. Source: the gate around a start that is start_sigma off, 0.16 m, and a quarter
  /// more.
  double start_margin = 0.2;
  /// How far off the base's surfaces may be at first. Unit: metres. Source: starts of the demo that
  /// are 2 to 20 cm off, sideways or along the ray, and come right all; with half of it the
  /// farthest along the ray is lost, double of it reaches no less.
  double start_sigma = 0.04;
  /// Iterations in which the base comes to rest from there. Unit: iterations. Source: the same
  /// starts: half of them are enough, and double change nothing.
  int start_iterations = 30;
  /// How far off joints may be where they are registered after the base: gates of several
  /// centimetres turn a disk onto its neighbours. Unit: metres. Source: wider gates drag parts onto
  /// each other (docs/mathematics.md).
  double start_joint_sigma = 0.005;
  /// Iterations in which they come to rest from there. Unit: iterations. Source: the same starts:
  /// half of them are enough, and double change nothing.
  int start_joint_iterations = 10;
  /// The whole frame is searched where no guess helps, at the start and when lost. Source: the tool
  /// is meant to need no guess.
  bool search_anywhere = true;
  /// What a search may take from one frame, at 1.5 seconds for each of its rounds and at least one
  /// round: one that needs more goes on in later frames (docs/initialization.md). No clock decides
  /// it, so that a recording gives the same each time. Not in the background, where no frame waits.
  /// Unit: seconds. Source: the user's, `--search-limit`, which is 1.5 unless told.
  double search_limit = std::numeric_limits<double>::infinity();
  /// Frames do not wait for searches, which then go on in a thread of their own: for live sources.
  /// What a recording gives depends on the clock with it, and not without. Source: whether the
  /// source is live.
  bool background_search = false;
  /// Where a search first finds nothing and the frame does not tell why, or what it finds is
  /// contradicted in a part, other readings of the frame are tried (search_failure.hpp), which
  /// takes some seconds: in the background after the second search that finds nothing. Source:
  /// `track` tells its user.
  bool try_other_readings = false;
  /// Depths in another unit are among these readings; they should be only where nobody has said
  /// which unit it is. Source: whether the source says it.
  bool try_other_units = true;
  /// Ends searches, which may take a minute: process() then throws Stopped within some tenths of a
  /// second. Frames that need no search are not stopped.
  StopRequest stop_request = nullptr;

  // The iterations of a frame are few because predictions are good. After one that was not, more
  // follow in rounds.

  /// Surfaces that the last iteration of a round moves by less are at rest. Unit: metres. Source:
  /// more than noise moves them by.
  double resting_move = 0.001;
  /// Each further round has so many iterations. Unit: iterations. Source: steps of 3 cm in a
  /// board's plane, of which three iterations did not reach the end.
  int further_iterations = 6;
  /// At most so many further rounds follow. Unit: rounds. Source: the same steps of 3 cm.
  int most_rounds = 8;

  // What `tracking` needs.

  /// The share of the visible surface that is explained. Below half of it the object is `lost`.
  /// Source: an arm that hides the demo's object down to 0.40: half and double of it change
  /// nothing, four times as much makes 14 of 80 right frames `uncertain`.
  double least_explained = 0.15;
  /// The explained share of what is explained or contradicted. Source: a cabinet a quarter turn off
  /// reaches 0.89, right bodies 0.93.
  double least_agreement = 0.9;
  /// The same share for each body by itself, if at least least_body_pixels speak for it or against
  /// it. Source: right bodies have 0.93 and more, bodies that stand elsewhere 0 to 0.6
  /// (docs/mathematics.md).
  double least_body_agreement = 0.75;
  /// So many must speak for or against a body before it is classified by itself. Unit: pixels.
  /// Source: four independent witnesses, each of them noise_correlation pixels.
  double least_body_pixels = 80.0;
  /// A body is contradicted if groups behind it are a larger share of what speaks for it or against
  /// it, and more than least_body_pixels. Source: none of 585 and 200 frames of fast motion and of
  /// steps was trusted wrongly with it.
  double most_groups_behind = 0.03;
  /// The share of the contour at which the scene goes on as the model's surface. Source: it
  /// is 0.97 around a plate found in a bare wall, and up to 0.64 around boxes on tables
  /// (docs/mathematics.md).
  double most_continued = 0.85;
  /// Surfaces that the last iteration moves farther are not where they belong. Unit: metres.
  /// Source: steps of 3 cm in a board's plane, of which 65 of 100 frames were trusted wrongly
  /// without.
  double most_last_move = 0.003;
  /// The standard deviation of the base's position as the frame tells it, what the object misfits
  /// included: the corner of a board in a wall fits. Unit: metres. Source: half of what counts as
  /// right (docs/experiments.md).
  double most_base_sigma = 0.01;
  /// The standard deviation of the way the base is turned, by noise alone. Unit: radians. Source: a
  /// degree, half of what counts as right. Doubled, what is turned by more than counts as right may
  /// be `tracking`; halved, more of what is small or far away is not.
  double most_base_turning_sigma = 0.0175;
  /// Where Candidate::rival_distance is larger, something else may be right as well. Unit: metres.
  /// Source: docs/verification.md; what is a metre away and one in 40,000 makes so much.
  double most_rival_distance = 0.005;
  /// A joint that slides and whose standard deviation is larger is not reported as known. Unit:
  /// metres. Source: a third of the 1 cm that counts as right (docs/experiments.md).
  double most_sliding_sigma = 0.0033;
  /// A joint that turns and whose standard deviation is larger is not reported as known. Unit:
  /// radians. Source: a third of the 5 degrees that count as right.
  double most_turning_sigma = 0.029;
  /// What is believed more is the object (lockbox/verification/belief.hpp): bodies that
  /// contradict the image do not change that, but joints that move them are not known; and what a
  /// search finds is kept even where it would drift off if gates were wider. Source: of a thousand
  /// such answers one may be wrong.
  double convincing_belief = 0.999;
  /// To ask the image takes as long as a frame. Doubled, belief lags twice as long behind what has
  /// become of the object while its status stays the same. Unit: frames. Source: asked seldom
  /// enough that one frame in twenty is not slower; two seconds.
  int frames_between_beliefs = 60;
  /// The sensor's noise is estimated from the first frames, then from every so many together, some
  /// rows of each, and the estimate goes by it. Doubled, a camera that doubles its distance in a
  /// second is taken for a wrong one half the way. 0, or where registration has another noise or
  /// correlation than by default: it is what is given. Unit: frames. Source: a second.
  int frames_between_noises = 30;
  /// Alternatives that are reported. Unit: answers. Source: the column `alternatives` of states.csv
  /// (docs/file-formats.md).
  std::size_t most_alternatives = 3;
  /// A joint that was sought over its whole range, while less than this share of what it moves is
  /// explained, is known only by least_margin_of_hidden. Source: of five wrong joints in 1000
  /// random scenes four were such, and one in ninety of the right ones.
  double least_of_sought_body = 0.5;
  /// The image must speak for its position by so many more (JointMargins) than for any other.
  /// Unit: pixels. Source: the same scenes.
  double least_margin_of_hidden = 25.0;
  /// The explained share of what is explained or contradicted, below which the object is `lost`.
  /// Source: bodies that stand elsewhere have 0 to 0.6 (docs/mathematics.md).
  double lost_agreement = 0.60;
};

/// Makes the noise, its correlation and the range of depths those of the sensor, whatever images
/// show.
void assume_sensor(const SensorProfile& sensor, TrackerOptions& options);

/// Makes this the noise, and its correlation that of the registration.
void assume_noise(const SensorNoise& noise, RegistrationOptions& registration);

}  // namespace lockbox
