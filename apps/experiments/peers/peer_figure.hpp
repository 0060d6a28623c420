// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "lockbox/evaluation/figure.hpp"
#include "peer_runs.hpp"
#include "published_figures.hpp"

namespace lockbox::app {

/// Errors over the frames of the whole sequences: of each frame the median over the seeds.
/// Lines show what another tracker reaches.
Figure peer_figure(const std::string& name, const std::vector<PeerRun>& runs,
                   const PublishedFigures& published);

}  // namespace lockbox::app
