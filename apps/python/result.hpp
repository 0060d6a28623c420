// SPDX-License-Identifier: BSD-3-Clause
// What a frame told, as Python sees it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "poses.hpp"

namespace lockbox::python {

struct Alternative {
  std::string kind;
  State state;
  double probability;
};

struct Result {
  double time;
  std::string status;
  double belief;
  State state;        ///< NaN while nothing is known
  JointValues sigma;  ///< see joint_sigma()
  Eigen::MatrixXd covariance;
  std::optional<std::string> reason;  ///< why nothing is known
  double residual_rms;
  double explained;
  double contradicted;
  std::vector<Alternative> alternatives;
  std::optional<ApparentSize> apparent_size;  ///< none until it was measured
  double seconds;
};

/// Poses and joints are NaN while nothing is known.
Result to_result(const KinematicTree& tree, const TrackingResult& result);

/// Declares Result, Alternative and ApparentSize.
void bind_result(pybind11::module_& module);

}  // namespace lockbox::python
