// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "lockbox/model/configuration.hpp"

namespace lockbox {

/// Where the object may be as well.
struct ShownAlternative {
  std::string name;  ///< what differs, and how probable it is: "flip 2 %"
  Configuration configuration;
};

/// What is known of the model in a frame.
struct ShownEstimate {
  ShownEstimate() = default;
  ShownEstimate(Configuration where, std::vector<double> deviations = {})
      : configuration(std::move(where)), sigma(std::move(deviations)) {}

  Configuration configuration;  ///< NaN while it is not known
  std::vector<double> sigma;    ///< of the joints, by index, radians or metres; empty: not told
  /// Of a step (base twist, joint variables), as TrackingResult has it; empty: not told.
  Eigen::MatrixXd covariance;
  std::string belief;  ///< a line on belief and alternatives; empty: not told
  std::vector<ShownAlternative> alternatives;  ///< the most probable first
};

/// kind: a word of states files, such as flip. probability: in [0, 1].
std::string alternative_name(const std::string& kind, double probability);

/// "belief 97 %; or flip 2 %, elsewhere 1 %". alternatives: kind:probability, separated by
/// semicolons, as in states files.
std::string belief_line(double belief, const std::string& alternatives);

}  // namespace lockbox
