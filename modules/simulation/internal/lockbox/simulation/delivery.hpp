// SPDX-License-Identifier: BSD-3-Clause
// Which frames of a run arrive, and what they show.
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/model/states_file.hpp"
#include "lockbox/simulation/deviation.hpp"

namespace lockbox {

struct DeliveredFrame {
  /// What the image shows: with the stamp of the frame, in a repeated one the configuration of the
  /// frame before.
  State state;
  bool is_repeated = false;
};

/// The frames that arrive of such a run. The first one always does, and is not repeated.
std::vector<DeliveredFrame> delivered_frames(const std::vector<State>& run,
                                             const FrameDeviation& deviation, std::uint64_t seed);

}  // namespace lockbox
