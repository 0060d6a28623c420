// SPDX-License-Identifier: BSD-3-Clause
// The clouds of a folder, and their times.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lockbox {

/// All .pcd files, in natural order of their names (natural_order.hpp); hidden ones are left out.
std::vector<std::filesystem::path> pcd_files(const std::filesystem::path& folder);

struct TimedClouds {
  std::vector<std::filesystem::path> files;
  std::vector<double> stamps;  ///< seconds, one a file
};

/// If all names hold a stamp (stamp_in_name.hpp), in the order of these; else in natural order,
/// 1/30 s apart. Stamps in another unit than seconds are converted, and told to warn, if it is set.
TimedClouds timed_clouds(const std::filesystem::path& folder,
                         const std::function<void(const std::string&)>& warn);

}  // namespace lockbox
