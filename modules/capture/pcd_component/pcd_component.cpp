// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_component.hpp"

#include <pcl/io/lzf.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

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

__attribute__((visibility("default"))) bool lockbox_decompress_lzf(const char* packed,
                                                                   std::size_t size,
                                                                   std::vector<char>& data) {
  return pcl::lzfDecompress(packed, static_cast<unsigned int>(size), data.data(),
                            static_cast<unsigned int>(data.size())) == data.size();
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
