// SPDX-License-Identifier: BSD-3-Clause
// How sure the estimate is: the sandwich H^-1 S H^-1 (White 1980), with S summed over image tiles
// (cluster-robust, Liang and Zeger 1986), so that noise which neighbouring pixels share counts as
// what it is, and a systematic floor.
#pragma once

#include <vector>

#include "lockbox/registration/bounded_step.hpp"
#include "lockbox/registration/model_term.hpp"

namespace lockbox {

/// Covariance of (base twist, variables) from the data terms linearised at the solution. Unknowns
/// with sigma of a whole unit or more are reported as not observable; held ones have sigma 0.
void estimate_covariance(const KinematicTree& tree, const NormalEquations& data,
                         const std::vector<ModelTerm::TileGradient>& tile_gradients,
                         const std::vector<BodyJacobian>& jacobians, const StepScale& scale,
                         const std::vector<bool>& held, Eigen::MatrixXd& covariance,
                         Eigen::VectorXd& sigma, std::vector<bool>& observable);

}  // namespace lockbox
