// SPDX-License-Identifier: BSD-3-Clause
// A cached distance field, whose length, key and checksum are made right. What is taken is looked
// up everywhere.
#include "field_file.hpp"

#include <array>
#include <cstring>
#include <limits>
#include <span>

#include "fuzz_input.hpp"
#include "lockbox/mesh/content_hash.hpp"

namespace lockbox {
namespace {

constexpr std::uint64_t kKey = 1;

// Of the header: magic, format and size of the header, key, size of what follows, its checksum.
constexpr std::size_t kKeyAt = 16;
constexpr std::size_t kHeader = 40;

std::string with_header(std::string bytes) {
  if (bytes.size() < kHeader) return bytes;
  const auto payload = std::span(bytes).subspan(kHeader);
  ContentHash hash;
  hash.add(std::as_bytes(payload));
  const std::array<std::uint64_t, 3> words = {kKey, payload.size(), hash.value()};
  std::memcpy(bytes.data() + kKeyAt, words.data(), sizeof words);
  return bytes;
}

void look_up(const SignedDistanceField& field) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float x : {-kInfinity, -1e30F, -1.0F, -0.01F, 0.0F, 0.003F, 0.02F, 1.0F, 1e30F}) {
    for (const float y : {-0.01F, 0.0F, 0.004F, 1e9F}) {
      for (const float z : {-0.01F, 0.0F, 0.005F, 1e9F}) field.sample({x, y, z});
    }
  }
  field.sample({std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F});
}

}  // namespace
}  // namespace lockbox

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockbox;
  auto storage = from_bytes(with_header(as_text(data, size)), kKey);
  if (storage) look_up(SignedDistanceField(*std::move(storage)));
  return 0;
}
