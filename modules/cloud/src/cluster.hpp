// SPDX-License-Identifier: BSD-3-Clause
// Which samples are near the expected object, and which of them hang together.
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/cloud/segmentation.hpp"
#include "sample_grid.hpp"

namespace lockbox {

/// One byte a sample: 1 within `margin` (metres) of the box of one of the bodies.
std::vector<std::uint8_t> near_bodies(const SampleGrid& grid,
                                      const std::vector<ExpectedBody>& bodies, double margin);

/// Among the candidate samples (one byte a sample), those of the clusters of which at least half is
/// near the object. gap: neighbours farther apart belong to different clusters, metres.
std::vector<std::uint8_t> clusters_of_object(const SampleGrid& grid,
                                             const std::vector<std::uint8_t>& candidates,
                                             const std::vector<std::uint8_t>& near_object,
                                             double gap);

}  // namespace lockbox
