// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "image_belief.hpp"
#include "lockbox/model/look_alikes.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/tracking/answer.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox {

/// What a search could not tell apart in its frame is followed through the next ones, all of it,
/// and compared in each: an alignment and a look at the image for each rival, where another search
/// takes a hundred times as long. All that is given must outlive it.
class RivalComparison {
 public:
  RivalComparison(const LookAlikes& look_alikes, const TrackerOptions& options,
                  ArticulatedRegistration& registration, const TiledCloud& cloud,
                  ImageBelief& image_belief)
      : look_alikes_(look_alikes),
        options_(options),
        registration_(registration),
        cloud_(cloud),
        image_belief_(image_belief) {}

  /// What the frames tell.
  struct Outcome {
    Answer answer;  ///< the one in whose favour they speak, with its belief
    bool is_rival;  ///< not what was followed
  };

  /// What frames before have left of an answer.
  struct Doubt {
    double belief;
    double rival_distance;  ///< metres to the nearest of the rivals
  };

  /// Begins with an answer that is followed from now on. rivals: what the search that has found it
  /// could not tell from it, if it doubts it. Where they are not all that may be right beside it,
  /// nothing comes of comparing them. An answer that frames before could not tell from others is
  /// compared with these again, whatever the search says, and these frames count: asked often
  /// enough, one frame or another would be for what is wrong. Returns what these leave of it, if it
  /// is such a one.
  std::optional<Doubt> begin(const Answer& answer, const std::vector<Alternative>& rivals);

  /// Nothing is left to be compared, or the frames before have not told.
  bool has_ended() const;

  /// Whether something else looks the same, whatever an image shows.
  bool is_hopeless(const Answer& followed) const {
    return !look_alikes_.of(followed.configuration).empty();
  }

  /// Compares them in the next frame, which the cloud shows. followed: the answer in it, as an
  /// alignment has found it. Returns nothing as long as the frames do not tell.
  std::optional<Outcome> compare(const Answer& followed);

 private:
  struct Rival {
    Answer answer;
    double evidence = 0.0;  ///< nats, the sum over the frames
  };

  bool goes_on(const Answer& answer);
  /// Nats in the mean of all frames: of what is followed, then of the rivals.
  std::vector<double> mean_evidence() const;

  const LookAlikes& look_alikes_;
  const TrackerOptions& options_;
  ArticulatedRegistration& registration_;
  const TiledCloud& cloud_;
  ImageBelief& image_belief_;
  std::vector<Rival> rivals_;
  Rival followed_;
  int frames_ = 0;   ///< of the sums
  int ends_at_ = 0;  ///< of them
};

}  // namespace lockbox
