// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

/// Returns by joint variable how far what it moves stands out from all that it does not move,
/// metres: the largest distance of a surface, at the ends and in the middle of its range with the
/// other joints at rest. Infinite where nothing else has geometry.
Eigen::VectorXd joint_prominences(const ArticulatedModel& model);

}  // namespace lockbox
