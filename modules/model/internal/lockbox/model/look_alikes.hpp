// SPDX-License-Identifier: BSD-3-Clause
// Configurations of an articulated model that no image tells apart: an arm of square links on a
// square foot stands as well on its foot turned by a quarter, its first joint turned back by as
// much.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/configuration.hpp"

namespace lockbox {

/// Finds them by what each body looks like by itself. The model must outlive it.
class LookAlikes {
 public:
  /// locked: variables that keep their positions, by variable; empty: none.
  explicit LookAlikes(const ArticulatedModel& model, std::vector<bool> locked = {});

  /// Returns configurations with another base, all joints within their limits, that look like the
  /// configuration; at most eight. A base that is turned about an axis about which it is round, all
  /// else being where it was, is none. Bodies without geometry are taken for what looks the same in
  /// no other pose.
  std::vector<Configuration> of(const Configuration& configuration) const;

 private:
  bool is_turn_of_round_base(const Eigen::Isometry3d& turn) const;

  const ArticulatedModel& model_;
  std::vector<bool> locked_;
  std::vector<Eigen::Isometry3d> turns_;  ///< of the base, which alone looks the same after them
  std::vector<std::vector<Eigen::Isometry3d>> symmetries_;  ///< by body
};

}  // namespace lockbox
