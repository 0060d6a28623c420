// SPDX-License-Identifier: BSD-3-Clause
// Finds the object in a frame when following it is not possible: at the start, and when lost.
#pragma once

#include <memory>
#include <optional>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/initialization/initializer.hpp"
#include "lockbox/model/look_alikes.hpp"
#include "lockbox/tracking/classification.hpp"
#include "lockbox/tracking/search_failure.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox {

/// Where to look: around a guess, if there is one, anywhere, or there first and then anywhere. A
/// guess that somebody gave is kept where the image agrees with it, within
/// TrackerOptions::start_sigma of it, though it may not determine it: one carton among others of
/// its kind is the one that was meant.
enum class SearchScope { near, anywhere, near_first, given_first };

/// Keeps the one of two answers in one frame that has the higher score (classification.hpp), the
/// earlier one of equals. Returns whether that is the first one.
bool keep_better(const Answer& answer, const TrackerOptions& options, Answer& best);

/// It may as well stand so far away: its standard deviations say so.
void doubt_base(double rival_distance, Answer& answer);

/// What a first answer has doubted is not known where it is followed to, either.
void keep_doubts(const Answer& answer, Answer& followed);

/// Uses the tracker's registration, and looks at its cloud; they and the model must outlive it.
class Acquisition {
 public:
  Acquisition(const ArticulatedModel& model, const TrackerOptions& options,
              const Executor& executor, ArticulatedRegistration& registration,
              const TiledCloud& cloud);

  /// Looks until an answer is classified `tracking`. Returns the most convincing one, even if it is
  /// not; none if nothing in view resembles the model. Joints of which it is doubtful where they
  /// are count as not observable. Locked ones stand as in the guess, or at rest without one. The
  /// cloud must hold the frame.
  std::optional<Answer> find(const DepthFrame& frame, const std::optional<Configuration>& guess,
                             SearchScope scope);

  /// Registers the base alone within a wide gate, then everything within a narrow one.
  Answer find_near(const Configuration& guess);

  /// Whatever a search has come to, the next one begins with its first round.
  void begin_anew() { progress_ = {}; }

  /// Makes what the first search would take its time for.
  void prepare() { initializer(); }

  /// What alignments and searches assume from now on.
  void assume(const RegistrationOptions& registration);

  /// How often find() has looked anywhere.
  int searches() const { return searches_; }

  /// Why the last time that find() looked anywhere gave no answer that is classified `tracking`;
  /// none if it did, or has not looked anywhere yet. What is contradicted in part, while its mirror
  /// image is convincing, counts as no answer.
  const std::optional<SearchFailure>& failure() const { return failure_; }

  /// Returns what the last search of the whole frame could not tell from what it has found.
  const std::vector<Alternative>& alternatives() const { return alternatives_; }

  /// Configurations that no image tells apart.
  const LookAlikes& look_alikes() const { return *look_alikes_; }

  /// Seeks joints over their whole range and registers everything from there. Those of which it is
  /// doubtful where they are count as not observable. The cloud must hold the frame.
  Answer with_joints_sought(const Configuration& start, const std::vector<int>& variables);

  /// Seeks single joints over their whole range, see Initializer::find_joints.
  SoughtJoints find_joints(const Configuration& start, const std::vector<int>& variables);

 private:
  void look_anywhere(const std::optional<Configuration>& guess);
  bool is_found() const;
  SearchFailure explain(const DepthFrame& frame);
  void try_once_otherwise(const DepthFrame& frame, SearchFailure& failure);
  bool is_rather_misread(const DepthFrame& frame);
  Answer registered(const Candidate& candidate, const AlignOptions& how);
  bool ends_search(const Candidate& candidate, const Answer& found);
  void doubt_if_rivalled(const Candidate& answer, const std::vector<Candidate>& candidates);
  void doubt_joints(const JointMargins& margins, Answer& answer) const;
  bool find_from(const Configuration& guess, SearchScope scope);
  bool consider(const Answer& found);
  bool is_enough(const Answer& found, const Configuration& guess, SearchScope scope);
  AlignOptions narrow() const;
  std::vector<int> dragged_variables(const Configuration& guess, const Answer& answer) const;
  void find_object(const Configuration& start);
  Initializer& initializer();

  const ArticulatedModel& model_;
  TrackerOptions options_;
  Executor executor_;
  ArticulatedRegistration& registration_;
  const TiledCloud& cloud_;
  TiledCloud object_;  ///< the same, but for points that cannot be the object
  std::shared_ptr<const LookAlikes> look_alikes_;
  std::optional<Initializer> initializer_;  ///< made when it is first needed: it draws the model
  std::optional<Answer> best_;
  std::optional<SearchFailure> failure_;
  std::vector<Alternative> alternatives_;
  SearchProgress progress_;
  bool was_read_otherwise_ = false;  ///< other readings were tried
  int failures_ = 0;                 ///< searches in the background that gave no answer
  int searches_ = 0;
};

}  // namespace lockbox
