// SPDX-License-Identifier: BSD-3-Clause
// The model's surface as points, for those who think in clouds.
#pragma once

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include <Eigen/Geometry>
#include <vector>

#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

struct ModelSample {
  Eigen::Vector3d p_body;
  Eigen::Vector3d normal;  ///< unit, body frame
  Eigen::Vector4f rgba;
  std::size_t body;
};

/// Samples of all bodies, evenly spread, body by body.
class ModelSamples {
 public:
  /// spacing: metres.
  ModelSamples(const ArticulatedModel& model, double spacing);

  const std::vector<ModelSample>& all() const { return samples_; }

  /// Number of the body's sample nearest to p_body; the body must have geometry.
  std::size_t nearest(std::size_t body, const Eigen::Vector3f& p_body) const;

 private:
  struct BodySamples {
    std::size_t first = 0;
    pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  };
  std::vector<ModelSample> samples_;
  std::vector<BodySamples> bodies_;
};

/// Returns the spacing of samples with which the model gets about so many of them, metres.
double sample_spacing(const ArticulatedModel& model, std::size_t count);

}  // namespace lockbox
