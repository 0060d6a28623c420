// SPDX-License-Identifier: BSD-3-Clause
// The same measurements as PCL's users know them.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/depth_frame.hpp"

namespace lockbox {

static_assert(EIGEN_DEFAULT_ALIGN_BYTES == 16,
              "PCL is built for 16-byte alignment: memory that it allocates and code compiled with "
              "AVX frees ends the process. Compile without -march, -mavx.");

/// Makes an organized cloud in the camera's optical frame, metres; it holds NaN where nothing was
/// measured. The stamp of its header counts microseconds. Throws InputError if camera and depth do
/// not fit together.
pcl::PointCloud<pcl::PointXYZ>::Ptr to_point_cloud(const DepthFrame& frame);

/// Does the same with the filtered depth, whatever keep() left out. stamp: seconds.
pcl::PointCloud<pcl::PointXYZ>::Ptr to_point_cloud(const TiledCloud& cloud, double stamp = 0.0);

}  // namespace lockbox
