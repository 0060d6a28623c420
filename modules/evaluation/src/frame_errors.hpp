// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "lockbox/evaluation/metrics.hpp"

namespace lockbox {

/// Compares pairs of states of one model. `determined` is left to the caller.
class FrameComparison {
 public:
  /// The tree is referred to. extra_columns: of the estimate's file. equal: poses that count as
  /// the true one.
  FrameComparison(const KinematicTree& tree, const std::vector<std::string>& extra_columns,
                  EqualPoses equal = {});

  /// Throws InputError if a sigma of the estimate is not a number.
  FrameErrors compare(const State& estimate, const State& reference) const;

  /// The comparison with no estimate at all.
  FrameErrors nothing(double stamp) const;

 private:
  const KinematicTree& tree_;
  EqualPoses equal_;
  std::vector<int> sigma_columns_;  ///< by joint, into State::extra; -1 where there is none
};

}  // namespace lockbox
