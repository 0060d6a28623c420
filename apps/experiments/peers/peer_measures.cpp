// SPDX-License-Identifier: BSD-3-Clause
#include "peer_measures.hpp"

#include <algorithm>
#include <iterator>

#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/statistics.hpp"

namespace lockbox::app {

double base_mm(const PeerFrame& frame) {
  return kMillimetres * frame.outcome.translation;
}

double base_degrees(const PeerFrame& frame) {
  return kDegrees * frame.outcome.rotation;
}

double door_degrees(const PeerFrame& frame) {
  return kDegrees * frame.door;
}

double slide_mm(const PeerFrame& frame) {
  return kMillimetres * frame.slide;
}

double median(const std::vector<double>& values) {
  return summarize(values).median;
}

std::vector<PeerRun> selected(const std::vector<PeerRun>& runs, const std::string& tracker,
                              const std::string& sequence) {
  std::vector<PeerRun> result;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(result), [&](const PeerRun& run) {
    return run.tracker == tracker && run.sequence == sequence && run.every == 1;
  });
  return result;
}

}  // namespace lockbox::app
