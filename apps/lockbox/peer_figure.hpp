// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "lockbox/evaluation/figure.hpp"
#include "peer_runs.hpp"

namespace lockbox::app {

/// Errors over the frames of the whole sequences: of each frame the median over the seeds.
Figure peer_figure(const std::string& name, const std::vector<PeerRun>& runs);

}  // namespace lockbox::app
