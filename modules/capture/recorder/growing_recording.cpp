// SPDX-License-Identifier: BSD-3-Clause
#include "growing_recording.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <thread>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

using namespace std::chrono_literals;

/// What the fields of a record come after.
struct RecordStart {
  std::array<char, 4> magic;
  OniRecordType type;
  std::uint32_t node;
  std::uint32_t fields;   // bytes, with this
  std::uint32_t payload;  // bytes
};
constexpr std::array kMagic = {'N', 'I', 'R', '\0'};

}  // namespace

void GrowingRecording::update() {
  std::ifstream in(file_, std::ios::binary | std::ios::ate);
  const std::streamoff end = in.tellg();
  RecordStart record{};
  while (!is_complete() && in.seekg(next_) &&
         in.read(reinterpret_cast<char*>(&record), sizeof(record)) && record.magic == kMagic) {
    const std::streamoff after = next_ + std::streamoff{record.fields} + record.payload;
    if (after > end) {
      return;
    }
    next_ = after;
    last_type_ = record.type;
    frame_count_ += record.type == OniRecordType::new_data ? 1 : 0;
  }
}

bool GrowingRecording::is_complete() const {
  return last_type_ == OniRecordType::end;
}

void GrowingRecording::wait_for(OniRecordType type) {
  for (int i = 0; i < 5000; ++i) {
    update();
    if (last_type_ == type) {
      return;
    }
    std::this_thread::sleep_for(2ms);
  }
  throw DeviceError(file_.string() + ": OpenNI2 does not record; is the disk full?");
}

int complete_frames(const std::filesystem::path& file) {
  GrowingRecording recording(file);
  recording.update();
  if (!recording.is_complete()) {
    throw DeviceError(file.string() + ": OpenNI2 has not recorded to the end; is the disk full?");
  }
  return recording.frame_count();
}

std::uintmax_t room_for(const std::filesystem::path& file) {
  const std::uintmax_t on_disk = std::filesystem::space(file.parent_path()).available;
  rlimit limit{};
  if (::getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return on_disk;
  }
  std::error_code is_missing;
  const std::uintmax_t size = std::filesystem::file_size(file, is_missing);
  const std::uintmax_t used = is_missing ? 0 : std::min<std::uintmax_t>(size, limit.rlim_cur);
  return std::min<std::uintmax_t>(on_disk, limit.rlim_cur - used);
}

}  // namespace lockbox
