// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/delivery.hpp"

#include "lockbox/simulation/random_draws.hpp"

namespace lockbox {

std::vector<DeliveredFrame> delivered_frames(const std::vector<State>& run,
                                             const FrameDeviation& deviation, std::uint64_t seed) {
  constexpr std::uint64_t kDeliveryPurpose = 100;  // tells this use of the seed from others
  constexpr double kAlmost = 1e-6;                 // seconds; stamps are rounded
  const double period = deviation.rate > 0.0 ? 1.0 / deviation.rate : 0.0;
  RandomDraws random(seed, kDeliveryPurpose);
  std::vector<DeliveredFrame> frames;
  double due = 0.0;
  for (const State& state : run) {
    if (!frames.empty() && state.stamp < due - kAlmost) continue;
    due = frames.empty() || state.stamp > due + period ? state.stamp + period : due + period;
    const bool is_missing = random.chance(deviation.missing);
    const bool is_repeated = random.chance(deviation.repeated);
    if (frames.empty()) {
      frames.push_back({state, false});
    } else if (!is_missing) {
      DeliveredFrame frame{state, is_repeated};
      if (is_repeated) frame.state.configuration = frames.back().state.configuration;
      frames.push_back(frame);
    }
  }
  return frames;
}

}  // namespace lockbox
