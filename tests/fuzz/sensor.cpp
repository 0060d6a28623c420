// SPDX-License-Identifier: BSD-3-Clause
// The profile of a sensor.
#include "fuzz_input.hpp"
#include "lockbox/sensor/sensor_profile.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return lockbox::read_as("input.yaml", data, size,
                          [](const auto& file) { lockbox::read_sensor_profile(file); });
}
