// SPDX-License-Identifier: BSD-3-Clause
// The YAML file beside a URDF.
#include "model_parameters.hpp"

#include "door.hpp"
#include "fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const lockbox::KinematicTree tree = lockbox::door_tree();
  return lockbox::read_as("input.yaml", data, size, [](const auto& file) {
    lockbox::read_model_parameters(file, tree, [](const std::string&) {});
  });
}
