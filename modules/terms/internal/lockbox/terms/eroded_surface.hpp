// SPDX-License-Identifier: BSD-3-Clause
// A body's surface, moved inwards: samples of the level set f = -erosion of its field, to be looked
// up in the fields of other bodies.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/sdf/signed_distance_field.hpp"

namespace lockbox {

struct ErodedSurface {
  struct Sample {
    Eigen::Vector3f p_body;
    Eigen::Vector3f normal;
    double share;  ///< of the body's surface
  };
  /// Consecutive samples, which are neighbours, and the ball that they lie in.
  struct Group {
    std::size_t first;
    std::size_t size;  ///< padded
    Eigen::Vector3d centre;
    double radius;
  };

  static constexpr std::size_t kSamplesInGroup = 32;  ///< at most

  /// How deep the deepest sample sits in another body, metres; 0 if none does.
  double deepest_in(const SignedDistanceField& other, const Eigen::Isometry3d& T_other_body) const;

  std::vector<Sample> samples;
  std::vector<float> x;  ///< their p_body, padded, as the kernels read them
  std::vector<float> y;
  std::vector<float> z;
  std::vector<Group> groups;
};

/// The points of a body's mesh that erode() begins with.
std::vector<SurfaceSample> collision_samples(const TriangleMesh& mesh);

/// erosion: metres, not negative.
ErodedSurface erode(const SignedDistanceField& field, std::span<const SurfaceSample> surface,
                    double erosion);

}  // namespace lockbox
