// SPDX-License-Identifier: BSD-3-Clause
// A URDF beside the mesh that sound ones name.
#include "fuzz_input.hpp"
#include "lockbox/model/articulated_model.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockbox;
  static const TemporaryFolder folder;
  static const auto mesh = folder.write(
      "block.obj", "v 0 0 0\nv .1 0 0\nv 0 .1 0\nv 0 0 .1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto file = folder.write("input.urdf", as_text(data, size));
  take_or_refuse(folder, [&] { load_kinematic_tree(file); });
  return 0;
}
