// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "lockbox/sdf/signed_distance_field.hpp"

namespace lockbox {

/// Where and how deep a sample sits in the other body, and which way is out.
struct Penetration {
  double depth;  ///< metres, negative
  Eigen::Vector3d normal;
  Eigen::Vector3d point;
};

/// Finds the penetration of a sample at p that looks outward, both in the field's frame, in a body
/// eroded by `erosion` metres; nothing if it is outside.
std::optional<Penetration> penetration(const SignedDistanceField& field, const Eigen::Vector3f& p,
                                       const Eigen::Vector3f& outward, float erosion);

}  // namespace lockbox
