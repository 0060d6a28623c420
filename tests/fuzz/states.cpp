// SPDX-License-Identifier: BSD-3-Clause
// A states file.
#include "door.hpp"
#include "fuzz_input.hpp"
#include "lockbox/model/states_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const lockbox::KinematicTree tree = lockbox::door_tree();
  return lockbox::read_as("input.csv", data, size,
                          [](const auto& file) { lockbox::read_states(file, tree); });
}
