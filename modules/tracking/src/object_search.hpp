// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "lockbox/tracking/acquisition.hpp"
#include "lockbox/tracking/background_search.hpp"

namespace lockbox {

/// When the object is sought while it is not known where it is, and in which thread: frames of a
/// recording wait for a search, live ones do not. While nothing is found, searches pause for longer
/// and longer. All that is given must outlive it.
class ObjectSearch {
 public:
  ObjectSearch(const ArticulatedModel& model, const TrackerOptions& options,
               ArticulatedRegistration& registration, Acquisition& acquisition,
               const TiledCloud& cloud);

  /// Where the object was last believed to be, if anywhere: searches begin there.
  const std::optional<Configuration>& guess() const { return guess_; }

  /// The object is believed to be there: pauses begin anew.
  void believe(const Configuration& configuration);

  /// Gives up the search that goes on; the next one begins with its first round.
  void stop();

  /// What is found in this frame, if a search is due, or one in the background has ended. is_kept:
  /// see needs_no_search().
  std::optional<Answer> seek(const DepthFrame& frame, SearchScope scope, bool is_kept);

  /// Frames in which the object was sought since it was last tracked, or the view is another.
  int frames_searched() const { return frames_searched_; }

  /// How often the object was sought in the whole frame.
  int searches() const;

  /// See Acquisition, of the last search that has ended.
  const std::optional<SearchFailure>& failure() const;
  const std::vector<Alternative>& alternatives() const;

 private:
  std::optional<Answer> seek_in_background(const DepthFrame& frame, SearchScope scope, bool is_due,
                                           bool is_kept);
  std::optional<Answer> brought_up_to_date(const Answer& answer);
  std::optional<Answer> where_it_was();

  const ArticulatedModel& model_;
  const TrackerOptions& options_;
  ArticulatedRegistration& registration_;
  Acquisition& acquisition_;
  const TiledCloud& cloud_;
  std::optional<Configuration> guess_;
  int frames_searched_ = 0;
  std::ptrdiff_t measured_before_ = 0;            ///< pixels, when this view was first searched
  std::unique_ptr<BackgroundSearch> background_;  ///< made when it is first needed
  int answers_passed_ = 0;  ///< of it, in a row: right in their frames, not in the newest
};

}  // namespace lockbox
