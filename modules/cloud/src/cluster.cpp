// SPDX-License-Identifier: BSD-3-Clause
#include "cluster.hpp"

#include <pcl/filters/crop_box.h>
#include <pcl/segmentation/euclidean_cluster_comparator.h>
#include <pcl/segmentation/organized_connected_component_segmentation.h>

#include <algorithm>
#include <limits>

namespace lockbox {

// pcl::CropBox: boxes of any orientation, and it passes over points that are not measured.
std::vector<std::uint8_t> near_bodies(const SampleGrid& grid,
                                      const std::vector<ExpectedBody>& bodies, double margin) {
  std::vector<std::uint8_t> near(grid.size(), 0);
  pcl::CropBox<pcl::PointXYZ> crop;
  crop.setInputCloud(grid.points);
  for (const ExpectedBody& body : bodies) {
    if (body.box.isEmpty()) {
      continue;
    }
    const Eigen::Vector3d inflation = Eigen::Vector3d::Constant(margin);
    const Eigen::Vector3d low = body.box.min() - inflation;
    const Eigen::Vector3d high = body.box.max() + inflation;
    crop.setTransform(Eigen::Affine3f(body.T_camera_body.inverse().matrix().cast<float>()));
    crop.setMin(low.cast<float>().homogeneous());
    crop.setMax(high.cast<float>().homogeneous());
    std::vector<int> inside;
    crop.filter(inside);
    for (const int sample : inside) {
      near[static_cast<std::size_t>(sample)] = 1;
    }
  }
  return near;
}

// pcl::OrganizedConnectedComponentSegmentation: neighbours in the image are all that can touch, one
// pass finds the clusters. pcl::EuclideanClusterExtraction searches a kd-tree around every point.
std::vector<std::uint8_t> clusters_of_object(const SampleGrid& grid,
                                             const std::vector<std::uint8_t>& candidates,
                                             const std::vector<std::uint8_t>& near_object,
                                             double gap) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  const auto points = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>(*grid.points);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (candidates[i] == 0) {
      (*points)[i].getVector3fMap().setConstant(kUnknown);
    }
  }
  const auto comparator =
      pcl::make_shared<pcl::EuclideanClusterComparator<pcl::PointXYZ, pcl::Label>>();
  comparator->setInputCloud(points);
  comparator->setDistanceThreshold(static_cast<float>(gap), false);
  pcl::OrganizedConnectedComponentSegmentation<pcl::PointXYZ, pcl::Label> segmentation(comparator);
  segmentation.setInputCloud(points);
  pcl::PointCloud<pcl::Label> labels;
  std::vector<pcl::PointIndices> clusters;
  segmentation.segment(labels, clusters);

  std::vector<std::uint8_t> kept(grid.size(), 0);
  for (const pcl::PointIndices& cluster : clusters) {
    const auto near = std::count_if(
        cluster.indices.begin(), cluster.indices.end(),
        [&](int sample) { return near_object[static_cast<std::size_t>(sample)] != 0; });
    if (2 * static_cast<std::size_t>(near) >= cluster.indices.size()) {
      for (const int sample : cluster.indices) {
        kept[static_cast<std::size_t>(sample)] = 1;
      }
    }
  }
  return kept;
}

}  // namespace lockbox
