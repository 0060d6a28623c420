// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

/// Surfaces of all bodies, for measuring overlaps apart from the collision term.
class Overlaps {
 public:
  explicit Overlaps(const ArticulatedModel& model) : model_(model) {
    for (const Body& body : model.tree.bodies) {
      samples_.push_back(sample_surface(body.mesh, 0.006));
    }
  }

  /// How deep the one body's surface reaches into the other, metres.
  double between(std::size_t a, std::size_t b, const std::vector<Eigen::Isometry3d>& poses) const {
    return std::max(reach(a, b, poses), reach(b, a, poses));
  }

  /// The deepest of all overlaps, metres, but for those of links that a joint connects: their
  /// joint guides them.
  double deepest(const std::vector<Eigen::Isometry3d>& poses) const {
    double result = 0.0;
    for (std::size_t a = 0; a < samples_.size(); ++a) {
      for (std::size_t b = a + 1; b < samples_.size(); ++b) {
        const int joint = model_.tree.bodies[b].parent_joint;
        const bool guided =
            model_.tree.joints[static_cast<std::size_t>(joint)].parent_body == static_cast<int>(a);
        if (!guided) {
          result = std::max(result, between(a, b, poses));
        }
      }
    }
    return result;
  }

 private:
  double reach(std::size_t moving, std::size_t still,
               const std::vector<Eigen::Isometry3d>& poses) const {
    const Eigen::Isometry3d T = poses[still].inverse() * poses[moving];
    const SignedDistanceField& field = *model_.fields[still];
    double deepest = 0.0;
    if (!field.bounds().intersects(model_.fields[moving]->bounds().transformed(T))) {
      return deepest;
    }
    for (const SurfaceSample& sample : samples_[moving]) {
      const Eigen::Vector3d p = T * sample.position;
      if (field.bounds().contains(p)) {
        deepest = std::max(deepest, -static_cast<double>(field.sample(p.cast<float>()).distance));
      }
    }
    return deepest;
  }

  const ArticulatedModel& model_;
  std::vector<std::vector<SurfaceSample>> samples_;
};

}  // namespace lockbox
