// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_component.hpp"

#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <algorithm>

namespace {

pcl::PointCloud<pcl::PointXYZ> to_pcl(const lockbox::OrganizedCloud& cloud) {
  pcl::PointCloud<pcl::PointXYZ> points(static_cast<std::uint32_t>(cloud.width),
                                        static_cast<std::uint32_t>(cloud.height));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {cloud.xyz[3 * i], cloud.xyz[3 * i + 1], cloud.xyz[3 * i + 2]};
  }
  points.is_dense = false;
  return points;
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) bool lockbox_load_pcd(const std::filesystem::path& file,
                                                             lockbox::OrganizedCloud& cloud,
                                                             std::string& problem) try {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // the caller reports
  pcl::PointCloud<pcl::PointXYZ> points;
  if (pcl::PCDReader().read(file.string(), points) != 0) {
    problem = "PCL cannot read it";
    return false;
  }
  cloud.width = static_cast<int>(points.width);
  cloud.height = static_cast<int>(points.height);
  cloud.xyz.resize(points.size() * 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::copy_n(points[i].data, 3, cloud.xyz.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  return true;
} catch (const std::exception& error) {
  problem = error.what();
  return false;
}

__attribute__((visibility("default"))) bool lockbox_save_pcd(const std::filesystem::path& file,
                                                             const lockbox::OrganizedCloud& cloud,
                                                             std::string& problem) try {
  if (pcl::PCDWriter().writeBinaryCompressed(file.string(), to_pcl(cloud)) != 0) {
    problem = "PCL cannot write it";
    return false;
  }
  return true;
} catch (const std::exception& error) {
  problem = error.what();
  return false;
}
}
