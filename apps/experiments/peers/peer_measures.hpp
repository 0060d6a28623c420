// SPDX-License-Identifier: BSD-3-Clause
// What is measured of the runs of `lockbox experiment peers`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "peer_runs.hpp"

namespace lockbox::app {

using Measure = std::function<double(const PeerFrame&)>;

double base_mm(const PeerFrame& frame);
double base_degrees(const PeerFrame& frame);
double door_degrees(const PeerFrame& frame);
double slide_mm(const PeerFrame& frame);

double median(const std::vector<double>& values);

/// Returns the runs on all frames of a sequence.
std::vector<PeerRun> selected(const std::vector<PeerRun>& runs, const std::string& tracker,
                              const std::string& sequence);

}  // namespace lockbox::app
