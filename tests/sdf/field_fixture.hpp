// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <random>

#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/sdf/build_field.hpp"

namespace lockbox {

/// Fields with a short reach: the coarse grid is not what most tests are about.
inline SignedDistanceField field_of(const TriangleMesh& mesh, double voxel = 0.0,
                                    double far_reach = 0.05) {
  FieldOptions options;
  options.voxel = voxel;
  options.far_reach = far_reach;
  return build_field(mesh, options, Executor(1));
}

inline TriangleMesh moved(const TriangleMesh& mesh, double x, double y, double z) {
  return transformed(mesh, Eigen::Isometry3d(Eigen::Translation3d(x, y, z)));
}

/// Any rotation, within a metre of the origin.
inline Eigen::Isometry3d random_placement(std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::Quaterniond rotation(normal(random), normal(random), normal(random), normal(random));
  rotation.normalize();
  return Eigen::Translation3d(uniform(random), uniform(random), uniform(random)) * rotation;
}

struct SurfaceErrors {
  double mean_distance = 0.0;  ///< mean |distance| on the surface, voxels
  double wrong_signs = 0.0;    ///< share of points a voxel off the surface with the wrong sign
};

/// Against the surface of a mesh that is convex, closed and oriented.
inline SurfaceErrors surface_errors(const SignedDistanceField& field, const TriangleMesh& mesh,
                                    double count = 500.0) {
  SurfaceErrors errors;
  const Eigen::Vector3d centre = bounds(mesh).center();
  // A convex body shrunk by this lies a voxel deep at least, next to its edges too.
  const double shrunk = 1.0 - 2.0 * field.voxel() / field.thickness();
  const auto samples = sample_surface(mesh, std::sqrt(surface_area(mesh) / count));
  const auto distance = [&](const Eigen::Vector3d& p) {
    return static_cast<double>(field.sample(p.cast<float>()).distance);
  };
  for (const SurfaceSample& sample : samples) {
    const Eigen::Vector3d outside = sample.position + field.voxel() * sample.normal;
    const Eigen::Vector3d inside = centre + shrunk * (sample.position - centre);
    errors.mean_distance += std::abs(distance(sample.position)) / field.voxel();
    errors.wrong_signs += distance(outside) <= 0.0 ? 0.5 : 0.0;
    errors.wrong_signs += distance(inside) >= 0.0 ? 0.5 : 0.0;
  }
  errors.mean_distance /= static_cast<double>(samples.size());
  errors.wrong_signs /= static_cast<double>(samples.size());
  return errors;
}

/// Of the enclosed volume against the given one, relative.
inline double volume_error(const SignedDistanceField& field, double volume) {
  return field.enclosed_volume() / volume - 1.0;
}

}  // namespace lockbox
