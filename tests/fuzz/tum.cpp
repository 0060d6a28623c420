// SPDX-License-Identifier: BSD-3-Clause
// A trajectory in the format of the TUM data sets: what is taken for one holds poses, all finite.
#include "lockbox/evaluation/tum_trajectory.hpp"

#include <optional>

#include "fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockbox;
  static const TemporaryFolder folder;
  const auto file = folder.write("input.tum", as_text(data, size));
  std::optional<StatesFile> read;
  take_or_refuse(folder, [&] { read = read_tum_trajectory(file); });
  if (!read) return 0;
  require(is_tum_trajectory(file) == !read->states.empty(), "poses make it a trajectory");
  for (const State& state : read->states) {
    require(state.configuration.T_camera_base.matrix().allFinite(), "poses are finite");
  }
  return 0;
}
