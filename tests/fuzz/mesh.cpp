// SPDX-License-Identifier: BSD-3-Clause
// A mesh of the format LOCKBOX_FUZZED_FORMAT.
#include "fuzz_input.hpp"
#include "lockbox/mesh/load_mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return lockbox::read_as("input." LOCKBOX_FUZZED_FORMAT, data, size, [](const auto& file) {
    lockbox::load_mesh(file, {0.001, 0.001, -0.001});
  });
}
