// SPDX-License-Identifier: BSD-3-Clause
// When each joint moves: to one end of its range, to the other, and back to rest, without parts
// that pass through each other.
#pragma once

#include <array>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/simulation/trajectory.hpp"

namespace lockbox {

/// One joint's three moves between four positions; between moves it stands still.
struct JointMoves {
  static constexpr int kMoves = 3;

  std::array<double, kMoves + 1> positions;
  double duration = 0.0;  ///< of each move
  std::array<double, kMoves> begins{};
  int planned = 0;  ///< moves whose beginning is known

  double position(double time) const;
  double end_of(int move) const { return begins[static_cast<std::size_t>(move)] + duration; }
};

/// Times in shares of the run: every joint has pauses of its own, and as many moves overlap as
/// is_possible allows. A move waits until it is clear of where the other joints are, and are about
/// to go; where no order helps, parts do pass through each other.
class JointSchedule {
 public:
  JointSchedule(const KinematicTree& tree, const TrajectoryOptions& options);

  /// Returns the positions of all joint variables; share: of the run, 0 to 1.
  Eigen::VectorXd positions(double share) const;

 private:
  struct Waiting {
    std::size_t joint;
    double since;
  };

  void plan(const TrajectoryOptions& options);
  bool is_clear(std::size_t joint, double time, const TrajectoryOptions& options) const;
  double next_end(double time) const;

  std::vector<JointMoves> joints_;  ///< by variable
  double end_ = 1.0;                ///< of the last move, before times are scaled to the run
  Configuration rest_;
};

}  // namespace lockbox
