// SPDX-License-Identifier: BSD-3-Clause
// What a search could not tell from its answer.
#pragma once

#include <vector>

#include "lockbox/initialization/initializer.hpp"
#include "lockbox/solver/motion_metric.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox {

/// Returns those of the candidates that alone would make the base uncertain, and as many as it
/// takes to be sure that one of them or the answer is right; each once, the most probable first, at
/// most TrackerOptions::most_alternatives. answer: one of the candidates, which are the best first.
std::vector<Alternative> alternatives_to(const Candidate& answer,
                                         const std::vector<Candidate>& candidates,
                                         const TrackerOptions& options, const MotionMetric& moves);

}  // namespace lockbox
