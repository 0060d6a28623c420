// SPDX-License-Identifier: BSD-3-Clause
// A k-d tree that is built when it is first asked, not when it is given a cloud: an alignment that
// never looks for neighbours need not pay for them.
#pragma once

#include <pcl/search/kdtree.h>

#include <limits>
#include <vector>

namespace lockbox {

/// Unlike PCL's own, it finds nothing near a point that is not finite, where that ends the process;
/// where a neighbour's distance is expected, it is then NaN, which no range contains.
template <typename PointT>
class LazyTree : public pcl::search::KdTree<PointT> {
 public:
  using Base = pcl::search::KdTree<PointT>;
  using Base::nearestKSearch;
  using Base::radiusSearch;
  using typename Base::PointCloudConstPtr;

  void setInputCloud(const PointCloudConstPtr& cloud,
                     const pcl::IndicesConstPtr& indices = nullptr) override {
    this->input_ = cloud;
    this->indices_ = indices;
    is_built_ = false;
  }

  int nearestKSearch(const PointT& point, int k, pcl::Indices& neighbours,
                     std::vector<float>& squared_distances) const override {
    if (!can_search(point)) {
      neighbours.assign(1, -1);
      squared_distances.assign(1, std::numeric_limits<float>::quiet_NaN());
      return 0;
    }
    return Base::nearestKSearch(point, k, neighbours, squared_distances);
  }

  int radiusSearch(const PointT& point, double radius, pcl::Indices& neighbours,
                   std::vector<float>& squared_distances, unsigned int max_nn = 0) const override {
    if (!can_search(point)) {
      neighbours.clear();
      squared_distances.clear();
      return 0;
    }
    return Base::radiusSearch(point, radius, neighbours, squared_distances, max_nn);
  }

 private:
  bool can_search(const PointT& point) const {
    if (!this->input_ || this->input_->empty() || !this->getPointRepresentation()->isValid(point)) {
      return false;
    }
    if (!is_built_) {
      this->tree_->setInputCloud(this->input_, this->indices_);
      is_built_ = true;
    }
    return true;
  }

  mutable bool is_built_ = false;
};

}  // namespace lockbox
