// SPDX-License-Identifier: BSD-3-Clause
// The face of the component with PCL's writer and its compression of .pcd files.
#pragma once

#include <cstddef>
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

/// Functions that liblockbox_pcd.so exports under these names. They return whether they succeeded;
/// exceptions do not cross the boundary.
using DecompressLzf = bool(const char* packed, std::size_t size, std::vector<char>& data);
using SavePcd = bool(const std::filesystem::path& file, const OrganizedCloud& cloud,
                     std::string& problem);
inline constexpr char kPcdComponent[] = "liblockbox_pcd.so";
inline constexpr char kDecompressLzf[] = "lockbox_decompress_lzf";
inline constexpr char kSavePcd[] = "lockbox_save_pcd";

/// PCL looks at as many bytes behind data that is damaged.
inline constexpr std::size_t kLzfPadding = 2;

/// Returns whether packed, without the kLzfPadding bytes at its end, decompresses to exactly
/// data.size() bytes. Throws InputError if the component is not installed, as does save_pcd.
bool decompress_lzf(const std::vector<char>& packed, std::vector<char>& data);

/// Throws InputError if the file cannot be written.
void save_pcd(const std::filesystem::path& file, const OrganizedCloud& cloud);

}  // namespace lockbox
