// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_files.hpp"

#include <algorithm>
#include <numeric>

#include "natural_order.hpp"
#include "stamp_in_name.hpp"
#include "stamps_in_seconds.hpp"

namespace lockbox {
namespace {

constexpr double kPeriod = 1.0 / 30.0;  // seconds, where names hold no stamps

bool is_cloud(const std::filesystem::directory_entry& entry) {
  const std::filesystem::path& path = entry.path();
  const bool is_hidden = path.filename().string().front() == '.';
  return !is_hidden && (path.extension() == ".pcd" || path.extension() == ".PCD") &&
         !entry.is_directory();
}

/// Empty unless all names hold one.
std::vector<double> stamps_in(const std::vector<std::filesystem::path>& files) {
  std::vector<double> stamps;
  for (const std::filesystem::path& file : files) {
    const std::optional<double> stamp = stamp_in_name(file.stem().string());
    if (!stamp) {
      return {};
    }
    stamps.push_back(*stamp);
  }
  return stamps;
}

}  // namespace

std::vector<std::filesystem::path> pcd_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (is_cloud(entry)) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end(),
            [](const std::filesystem::path& a, const std::filesystem::path& b) {
              return natural_less(a.filename().string(), b.filename().string());
            });
  return files;
}

TimedClouds timed_clouds(const std::filesystem::path& folder,
                         const std::function<void(const std::string&)>& warn) {
  const std::vector<std::filesystem::path> files = pcd_files(folder);
  const std::vector<double> stamps = stamps_in(files);
  std::vector<std::size_t> order(files.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!stamps.empty()) {
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return stamps[a] < stamps[b]; });
  }
  TimedClouds clouds;
  for (const std::size_t file : order) {
    const double number = static_cast<double>(clouds.files.size());
    clouds.files.push_back(files[file]);
    clouds.stamps.push_back(stamps.empty() ? kPeriod * number : stamps[file]);
  }
  bring_to_seconds(clouds.stamps, folder.string(), warn);
  return clouds;
}

}  // namespace lockbox
