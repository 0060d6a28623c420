// SPDX-License-Identifier: BSD-3-Clause
// Between PCL's clouds of any point type and what the registration works with.
#pragma once

#include <pcl/common/transforms.h>
#include <pcl/point_cloud.h>
#include <pcl/type_traits.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "lockbox/core/lie.hpp"
#include "model_samples.hpp"
#include "scan.hpp"

namespace lockbox {

/// The matrix as a rigid motion, if it is one in as many digits as people write.
template <typename Scalar>
std::optional<Eigen::Isometry3d> rigid(const Eigen::Matrix<Scalar, 4, 4>& matrix) {
  constexpr double kDigits = 1e-2;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = matrix.template topLeftCorner<3, 3>().template cast<double>();
  T.translation() = matrix.template topRightCorner<3, 1>().template cast<double>();
  const Eigen::Matrix3d& R = T.linear();
  if (!T.matrix().allFinite() || !(R.transpose() * R).isIdentity(kDigits) ||
      R.determinant() < 0.0) {
    return std::nullopt;
  }
  return orthonormalized(T);
}

/// PCL keeps the sensor's pose as floats that nobody checks.
template <typename PointT>
Eigen::Isometry3d sensor_pose(const pcl::PointCloud<PointT>& cloud) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d origin = cloud.sensor_origin_.template head<3>().template cast<double>();
  const Eigen::Quaterniond orientation = cloud.sensor_orientation_.template cast<double>();
  if (origin.allFinite() && orientation.norm() > 0.0 && std::isfinite(orientation.norm())) {
    T.translation() = origin;
    T.linear() = orientation.normalized().toRotationMatrix();
  }
  return T;
}

template <typename PointT>
PointT to_point(const ModelSample& sample, const Eigen::Isometry3d& T_base_body) {
  PointT point;
  point.getVector3fMap() = (T_base_body * sample.p_body).cast<float>();
  if constexpr (pcl::traits::has_normal_v<PointT>) {
    point.getNormalVector3fMap() = (T_base_body.linear() * sample.normal).cast<float>();
  }
  if constexpr (pcl::traits::has_color_v<PointT>) {
    const Eigen::Array4f rgba = sample.rgba.array().max(0.0F).min(1.0F) * 255.0F;
    point.r = static_cast<std::uint8_t>(rgba[0]);
    point.g = static_cast<std::uint8_t>(rgba[1]);
    point.b = static_cast<std::uint8_t>(rgba[2]);
    point.a = static_cast<std::uint8_t>(rgba[3]);
  }
  return point;
}

template <typename PointT, typename Scalar>
void transform(const pcl::PointCloud<PointT>& from, pcl::PointCloud<PointT>& to,
               const Eigen::Matrix<Scalar, 4, 4>& T) {
  if constexpr (pcl::traits::has_normal_v<PointT>) {
    pcl::transformPointCloudWithNormals(from, to, T);
  } else {
    pcl::transformPointCloud(from, to, T);
  }
}

/// indices: of the points in use, each of which exists; null: all.
template <typename PointT>
Scan to_scan(const pcl::PointCloud<PointT>& cloud, const pcl::Indices* indices) {
  Scan scan;
  scan.points.reserve(cloud.size());
  for (const PointT& point : cloud) {
    scan.points.emplace_back(point.getVector3fMap());
  }
  scan.T_cloud_sensor = sensor_pose(cloud);
  // Somebody may have set width and height by hand.
  if (std::size_t{cloud.width} * cloud.height == cloud.size()) {
    scan.width = static_cast<int>(cloud.width);
    scan.height = static_cast<int>(cloud.height);
  }
  if (indices != nullptr) {
    scan.used.assign(cloud.size(), 0);
    for (const pcl::index_t i : *indices) scan.used[static_cast<std::size_t>(i)] = 1;
  }
  return scan;
}

}  // namespace lockbox
