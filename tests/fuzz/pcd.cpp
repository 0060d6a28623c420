// SPDX-License-Identifier: BSD-3-Clause
// A folder with one cloud.
#include "lockbox/capture/pcd_folder.hpp"

#include "fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockbox;
  static const TemporaryFolder folder;
  folder.write("input.pcd", as_text(data, size));
  take_or_refuse(folder, [&] {
    PcdFolderSource source(folder.path());
    for (DepthFrame frame; source.next(frame);) continue;
  });
  return 0;
}
