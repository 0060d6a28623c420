// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/cloud/point_cloud.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

#include "check_frame.hpp"

namespace lockbox {
namespace {

/// depth(pixel): metres, 0 where nothing was measured.
template <typename Depth>
pcl::PointCloud<pcl::PointXYZ>::Ptr back_projected(const PinholeCamera& camera, double stamp,
                                                   const Depth& depth) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  constexpr double kMicroseconds = 1e6;
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>(
      static_cast<std::uint32_t>(camera.width), static_cast<std::uint32_t>(camera.height),
      pcl::PointXYZ(kUnknown, kUnknown, kUnknown));
  cloud->is_dense = false;
  cloud->header.stamp = static_cast<std::uint64_t>(std::llround(stamp * kMicroseconds));
  std::size_t pixel = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u, ++pixel) {
      const float z = depth(pixel);
      if (z > 0.0F) {
        (*cloud)[pixel].getVector3fMap() = camera.back_project(u, v, z).cast<float>();
      }
    }
  }
  return cloud;
}

}  // namespace

pcl::PointCloud<pcl::PointXYZ>::Ptr to_point_cloud(const DepthFrame& frame) {
  check_frame(frame);
  return back_projected(frame.camera, frame.stamp, [&](std::size_t pixel) {
    return static_cast<float>(frame.depth[pixel]) * frame.metres_per_unit;
  });
}

pcl::PointCloud<pcl::PointXYZ>::Ptr to_point_cloud(const TiledCloud& cloud, double stamp) {
  return back_projected(cloud.camera(), stamp,
                        [&](std::size_t pixel) { return cloud.depth()[pixel]; });
}

}  // namespace lockbox
