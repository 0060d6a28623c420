// SPDX-License-Identifier: BSD-3-Clause
// The face of the component with PCL's reader and writer of .pcd files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lockbox {

/// An organized cloud, row by row; pixels without a measurement are NaN.
struct OrganizedCloud {
  int width = 0;
  int height = 0;
  std::vector<float> xyz;  ///< metres, three values a pixel
};

/// Functions that liblockbox_pcd.so exports under these names. They return whether they succeeded,
/// or else the reason in problem: exceptions do not cross the boundary.
using LoadPcd = bool(const std::filesystem::path& file, OrganizedCloud& cloud,
                     std::string& problem);
using SavePcd = bool(const std::filesystem::path& file, const OrganizedCloud& cloud,
                     std::string& problem);
inline constexpr char kPcdComponent[] = "liblockbox_pcd.so";
inline constexpr char kLoadPcd[] = "lockbox_load_pcd";
inline constexpr char kSavePcd[] = "lockbox_save_pcd";

/// Checks the file, loads the component, and reads. Throws InputError.
void load_pcd(const std::filesystem::path& file, OrganizedCloud& cloud);

/// Throws InputError.
void save_pcd(const std::filesystem::path& file, const OrganizedCloud& cloud);

}  // namespace lockbox
