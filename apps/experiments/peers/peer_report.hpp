// SPDX-License-Identifier: BSD-3-Clause
// What the runs of `lockbox experiment peers` say, beside what another tracker reaches.
#pragma once

#include <vector>

#include "lockbox/evaluation/table.hpp"
#include "peer_runs.hpp"
#include "published_figures.hpp"

namespace lockbox::app {

Table peer_frame_rows(const std::vector<PeerRun>& runs);
Table capture_rows(const std::vector<CaptureTrial>& trials);

/// Accuracy and times of the whole sequences (PeerRun::every is 1).
void print_peer_accuracy(const std::vector<PeerRun>& runs, const PublishedFigures& published);
void print_peer_times(const std::vector<PeerRun>& runs, const PublishedFigures& published);

/// The runs of the sequence `moving`.
void print_fast_motion(const std::vector<PeerRun>& runs, const PublishedFigures& published);
void print_capture(const std::vector<CaptureTrial>& trials, const PublishedFigures& published);

}  // namespace lockbox::app
