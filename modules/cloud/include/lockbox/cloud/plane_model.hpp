// SPDX-License-Identifier: BSD-3-Clause
// PCL's plane for sample consensus in ray coordinates (x/z, y/z, s/z): there planes are planes,
// too.
#pragma once

#include <pcl/sample_consensus/sac_model_plane.h>

#include <cmath>

namespace lockbox {

/// Draws triples that are wide apart: they give a plane more exactly, and PCL complains on the
/// console about collinear ones, which are frequent where disparity is rounded.
class PlaneModel : public pcl::SampleConsensusModelPlane<pcl::PointXYZ> {
 public:
  /// min_spread: twice the area of a triple's triangle, for rays at unit depth.
  PlaneModel(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& rays, const pcl::Indices& indices,
             float min_spread)
      : SampleConsensusModelPlane(rays, indices), min_spread_(min_spread) {}

 protected:
  bool isSampleGood(const pcl::Indices& samples) const override {
    const auto point = [&](std::size_t i) -> Eigen::Vector2f {
      return (*input_)[static_cast<std::size_t>(samples[i])].getVector3fMap().head<2>();
    };
    const Eigen::Vector2f first = point(1) - point(0);
    const Eigen::Vector2f second = point(2) - point(0);
    return std::abs(first.x() * second.y() - first.y() * second.x()) > min_spread_;
  }

 private:
  float min_spread_;
};

}  // namespace lockbox
