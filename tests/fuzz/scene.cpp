// SPDX-License-Identifier: BSD-3-Clause
// A scene of the simulation.
#include "lockbox/simulation/scene.hpp"

#include "fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return lockbox::read_as("input.yaml", data, size,
                          [](const auto& file) { lockbox::read_scene(file); });
}
