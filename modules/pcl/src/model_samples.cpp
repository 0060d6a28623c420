// SPDX-License-Identifier: BSD-3-Clause
#include "model_samples.hpp"

#include <cmath>

#include "lockbox/mesh/surface_sampling.hpp"

namespace lockbox {

ModelSamples::ModelSamples(const ArticulatedModel& model, double spacing)
    : bodies_(model.tree.bodies.size()) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    bodies_[b].first = samples_.size();
    const auto points = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
    for (const ColoredMesh& visual : model.tree.bodies[b].visuals) {
      for (const SurfaceSample& sample : sample_surface(visual.mesh, spacing)) {
        samples_.push_back({sample.position, sample.normal, visual.rgba, b});
        points->emplace_back().getVector3fMap() = sample.position.cast<float>();
      }
    }
    if (!points->empty()) {
      bodies_[b].tree.setInputCloud(points);
    }
  }
}

std::size_t ModelSamples::nearest(std::size_t body, const Eigen::Vector3f& p_body) const {
  pcl::Indices index(1);
  std::vector<float> squared_distance(1);
  const pcl::PointXYZ query(p_body.x(), p_body.y(), p_body.z());
  bodies_[body].tree.nearestKSearch(query, 1, index, squared_distance);
  return bodies_[body].first + static_cast<std::size_t>(index[0]);
}

double sample_spacing(const ArticulatedModel& model, std::size_t count) {
  double area = 0.0;
  for (const Body& body : model.tree.bodies) {
    for (const ColoredMesh& visual : body.visuals) {
      area += surface_area(visual.mesh);
    }
  }
  return std::sqrt(area / static_cast<double>(count));
}

}  // namespace lockbox
