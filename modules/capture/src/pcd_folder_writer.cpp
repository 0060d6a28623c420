// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstdio>

#include "cloud_camera.hpp"
#include "lockbox/capture/pcd_folder.hpp"
#include "lockbox/core/error.hpp"
#include "pcd_component.hpp"
#include "pcd_files.hpp"

namespace lockbox {

PcdFolderWriter::PcdFolderWriter(const std::filesystem::path& folder) : folder_(folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw InputError(folder.string(), "cannot be created (" + error.message() + ")");
  }
  if (!pcd_files(folder).empty()) {
    throw InputError(folder.string(),
                     "holds .pcd files already; remove them or choose another folder");
  }
}

void PcdFolderWriter::write(const DepthFrame& frame) const {
  if (!(frame.stamp >= 0.0)) {
    throw InputError(folder_.string(), "the stamps of frames must not be negative");
  }
  std::array<char, 64> name;  // zeros in front, so that name order is time order
  std::snprintf(name.data(), name.size(), "%018.6f.pcd", frame.stamp);
  save_pcd(folder_ / name.data(), cloud_of(frame));
}

}  // namespace lockbox
