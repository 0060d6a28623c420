// SPDX-License-Identifier: BSD-3-Clause
// An encoded image of a recording: which encoding, how many pixels (16 bits), and its bytes.
#include "fuzz_input.hpp"
#include "payload_checks.hpp"

namespace lockbox {
namespace {

void check_depth(std::span<const std::uint8_t> payload, std::size_t pixels, bool with_table) {
  const auto damage = find_damage_16z(payload, pixels, with_table);
  const auto sound = sound_pixels_16z(payload, with_table);
  if (!damage) require(sound == pixels, "an image without damage has as many pixels as it should");
  if (sound) {
    require(!find_damage_16z(payload, *sound, with_table), "an image of its own size is sound");
  }
}

}  // namespace
}  // namespace lockbox

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockbox;
  constexpr std::size_t kHead = 3;
  if (size < kHead) return 0;
  const std::size_t pixels = data[1] + std::size_t{256} * data[2];
  const auto payload = std::span(data, size).subspan(kHead);
  if (data[0] == 'J') {
    find_damage_jpeg(payload, pixels);
  } else {
    check_depth(payload, pixels, data[0] == 'T');
  }
  return 0;
}
