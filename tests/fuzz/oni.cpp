// SPDX-License-Identifier: BSD-3-Clause
// A recording, checked as before OpenNI2 sees it. What is sound is copied as the player has it
// copied, and the copy is plain.
#include "fuzz_input.hpp"
#include "lockbox/capture/oni_validator.hpp"

namespace lockbox {
namespace {

void check_and_copy(const std::filesystem::path& file, const std::filesystem::path& copy) {
  const OniRecording recording = validate_oni(file);
  OniPayloadChecker payloads(recording);
  if (!payloads.check_through(recording.frame_count) || !payloads.end_reason().empty()) return;
  copy_depth(recording, copy);
  const OniRecording copied = validate_oni(copy);
  require(copied.is_plain, "a copy is plain");
  require(copied.frame_count == recording.frame_count, "a copy has all depth images");
}

}  // namespace
}  // namespace lockbox

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockbox;
  static const TemporaryFolder folder;
  const auto file = folder.write("input.oni", as_text(data, size));
  take_or_refuse(folder, [&] { check_and_copy(file, folder / "copy.oni"); });
  return 0;
}
