// SPDX-License-Identifier: BSD-3-Clause
// Finds the object in a thread of its own, while the tracker's goes on with the frames.
#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <optional>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/tracking/acquisition.hpp"
#include "lockbox/tracking/tracker_options.hpp"

namespace lockbox {

/// One search at a time, in one frame each; what is found is then followed through the newest ones,
/// until it is no older than a few frames. The model must outlive it. All calls come from one
/// thread, and none of them waits for the search but the destructor, which stops it first.
class BackgroundSearch {
 public:
  BackgroundSearch(const ArticulatedModel& model, const TrackerOptions& options);
  ~BackgroundSearch();
  BackgroundSearch(const BackgroundSearch&) = delete;
  BackgroundSearch& operator=(const BackgroundSearch&) = delete;

  /// Returns whether it goes on: from start() until take() has met its end.
  bool is_busy() const { return running_.valid(); }

  /// Begins what Acquisition::find() does, with a copy of the frame. Not while it is busy.
  void start(const DepthFrame& frame, const std::optional<Configuration>& guess, SearchScope scope);

  /// A newer frame than that given to start(): what is found is to be followed into it.
  void show(const DepthFrame& frame);

  /// What was found, in the newest frame into which it could be followed, once after each search;
  /// none before its end, if nothing resembled the model, or if it was stopped. An error of the
  /// search comes out here.
  std::optional<Answer> take();

  /// Nobody needs the answer any more. It stays busy until the search has noticed, which takes some
  /// tenths of a second.
  void cancel();

  /// How often the object was sought in the whole frame, in searches that ended.
  int searches() const { return searches_; }

  /// See Acquisition::failure(), of the last search that has ended.
  const std::optional<SearchFailure>& failure() const { return failure_; }

  /// See Acquisition::alternatives(), likewise.
  const std::vector<Alternative>& alternatives() const { return alternatives_; }

 private:
  struct Seeker;
  using Clock = std::chrono::steady_clock;

  std::optional<Answer> find(const std::optional<Configuration>& guess, SearchScope scope);
  void catch_up(Answer& answer);
  bool take_newest();

  const ArticulatedModel& model_;
  TrackerOptions options_;
  Executor executor_;
  DepthFrame frame_;                ///< the search's own while it is busy
  Clock::time_point shown_at_;      ///< likewise: when frame_ was the newest
  std::unique_ptr<Seeker> seeker_;  ///< likewise
  std::mutex newest_mutex_;         ///< of the three below
  DepthFrame newest_;
  Clock::time_point newest_shown_at_;
  bool has_newer_ = false;  ///< than frame_
  std::atomic<bool> is_cancelled_{false};
  int searches_ = 0;
  std::optional<SearchFailure> failure_;
  std::vector<Alternative> alternatives_;
  std::future<std::optional<Answer>> running_;  ///< last: it goes first, and waits for the search
};

}  // namespace lockbox
