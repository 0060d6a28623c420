// SPDX-License-Identifier: BSD-3-Clause
#include "recordings.hpp"

#include <algorithm>
#include <filesystem>

#include "lockbox/capture/frame_source.hpp"
#include "lockbox/core/error.hpp"

namespace lockbox::app {
namespace {

namespace fs = std::filesystem;

bool is_recording_folder(const fs::path& folder) {
  if (fs::exists(folder / "depth.txt")) return true;
  return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [](const auto& entry) { return entry.path().extension() == ".pcd"; });
}

}  // namespace

std::vector<std::string> recordings_in(const std::string& source_or_folder) {
  require_source(source_or_folder);
  if (!fs::is_directory(source_or_folder) || is_recording_folder(source_or_folder)) {
    return {source_or_folder};
  }
  std::vector<std::string> recordings;
  for (const auto& entry : fs::directory_iterator(source_or_folder)) {
    const bool holds_frames = entry.is_directory() ? is_recording_folder(entry.path())
                                                   : entry.path().extension() == ".oni";
    if (holds_frames) recordings.push_back(entry.path().string());
  }
  if (recordings.empty()) {
    throw InputError(source_or_folder,
                     "holds no recordings; these are .oni files, folders with depth.txt, and "
                     "folders of .pcd files");
  }
  std::sort(recordings.begin(), recordings.end());
  return recordings;
}

}  // namespace lockbox::app
