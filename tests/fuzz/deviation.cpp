// SPDX-License-Identifier: BSD-3-Clause
// Deviations of an object from its model: what was read is written so that it is read again.
#include "lockbox/simulation/deviation.hpp"

#include <optional>

#include "fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockbox;
  static const TemporaryFolder folder;
  const auto file = folder.write("input.yaml", as_text(data, size));
  std::optional<Deviation> deviation;
  take_or_refuse(folder, [&] { deviation = read_deviation(file); });
  if (!deviation) return 0;
  const std::string text = deviation_text(*deviation);
  require(deviation_text(read_deviation(folder.write("again.yaml", text))) == text,
          "what was written is read as it was");
  return 0;
}
