// SPDX-License-Identifier: BSD-3-Clause
// Which joints are in sight, and which have been hidden.
#pragma once

#include <vector>

#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/tracking/classification.hpp"

namespace lockbox {

/// Counts for how many frames in a row each joint variable has been determined. One frame may
/// mistake a stranger for the part that comes back into sight; the second one tells. The tree must
/// outlive it.
class JointSight {
 public:
  explicit JointSight(const KinematicTree& tree);

  /// Returns the joint variables that are to be sought over their whole range in this frame, in
  /// order: those that are not known, but for those whose parts lie flush with what is around them,
  /// where seeking would find nothing. At most eight; of more, one after the other comes in turn,
  /// and those that wait are not known meanwhile.
  std::vector<int> sought();

  /// Whether the joint variable has been in sight for long enough to be reported.
  bool is_known(int variable) const;

  /// Notes which parts of an answer lie flush with what is around them: they are in view, and still
  /// not determined.
  void note_flush_parts(const Answer& found, const TrackerOptions& options);

  /// Counts a frame in which the object was followed. margins: of the joints that were sought in
  /// it.
  void count(const Answer& found, const JointMargins& margins, const TrackerOptions& options);

  /// Begins anew with what a search has found: what it determines is known at once.
  void begin(const Answer& found);

 private:
  bool is_flush(const Answer& found, int variable, const TrackerOptions& options) const;

  const KinematicTree& tree_;
  int next_ = 0;                      ///< the variable whose turn it is
  std::vector<bool> waits_;           ///< by variable: not known, and not sought in this frame
  std::vector<int> frames_in_sight_;  ///< by variable: consecutive, up to the present
  std::vector<bool> is_flush_;        ///< by variable
};

}  // namespace lockbox
