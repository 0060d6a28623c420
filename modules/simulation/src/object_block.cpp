// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/object_block.hpp"

#include <charconv>

#include "lockbox/core/error.hpp"

namespace lockbox {

ObjectBlock::ObjectBlock(const std::string& name) : name_(name) {
  constexpr std::string_view kTest = "test:";
  if (name == "tune") return;
  is_for_tuning_ = false;
  const char* const end = name.data() + name.size();
  const bool is_test = name.rfind(kTest, 0) == 0;
  const auto read = std::from_chars(is_test ? name.data() + kTest.size() : end, end, block_);
  if (!is_test || read.ec != std::errc() || read.ptr != end) {
    throw InputError("block " + in_quotes(name),
                     "is none; write tune, or test: and a whole number, such as test:1");
  }
}

RandomDraws ObjectBlock::draws(Purpose purpose, std::uint64_t number) const {
  constexpr std::uint64_t kBlocks = 0x6f626a6563740000U;  // apart from the seeds of other draws
  const std::uint64_t block = is_for_tuning_ ? 0 : block_ + 1;
  return {(kBlocks + block) * 8 + static_cast<std::uint64_t>(purpose), number};
}

}  // namespace lockbox
