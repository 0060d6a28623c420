// SPDX-License-Identifier: BSD-3-Clause
// The signed distance to one rigid body, sampled near its surface and coarsely far from it.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lockbox/kernels/field_view.hpp"

namespace lockbox {

/// Distance (metres, negative inside) and its gradient (1, body frame).
struct DistanceSample {
  float distance;            ///< metres, negative inside
  Eigen::Vector3f gradient;  ///< metres a metre, body frame
};

/// Immutable after it is built or read from the cache; safe to share between threads.
class SignedDistanceField {
 public:
  /// The arrays behind view(); see field_view.hpp for their layout.
  struct Storage {
    FieldView grid;  ///< pointers unset
    /// What FieldView::samples points to, with the spare one.
    std::vector<std::int16_t> samples;
    /// What FieldView::block_first points to.
    std::vector<std::int32_t> block_first;
    Eigen::AlignedBox3d bounds;  ///< of the body's surface
    double mesh_volume = 0.0;    ///< enclosed by the mesh, m^3
    double thickness = 0.0;      ///< of the thinnest wall, metres
  };

  /// Takes the arrays over; build_field() and the cache make them.
  explicit SignedDistanceField(Storage storage);
  // Copying would leave the view pointing into the original.
  SignedDistanceField(const SignedDistanceField&) = delete;
  SignedDistanceField& operator=(const SignedDistanceField&) = delete;
  SignedDistanceField(SignedDistanceField&&) noexcept;
  SignedDistanceField& operator=(SignedDistanceField&&) noexcept;

  /// Returns what inner loops read; valid as long as the field.
  const FieldView& view() const { return view_; }
  /// Returns what the cache writes.
  const Storage& storage() const { return storage_; }
  /// Returns the box of the body's surface, body frame, metres.
  const Eigen::AlignedBox3d& bounds() const { return storage_.bounds; }
  /// Returns the distance between fine samples, metres.
  double voxel() const { return static_cast<double>(view_.fine_voxel); }
  /// Returns the thickness of the thinnest wall, metres.
  double thickness() const { return storage_.thickness; }

  /// Returns the tri-linear distance at p (metres, body frame) and the exact gradient of that
  /// interpolant. Beyond the coarse grid it is the distance at its border plus the way to it, along
  /// that way. What no float can count in voxels (NaN, infinity) is infinitely far outside, without
  /// a gradient.
  DistanceSample sample(const Eigen::Vector3f& p) const;

  /// Returns the volume where the interpolant is negative, m^3.
  double enclosed_volume() const;

  /// Returns how many bytes the arrays take.
  std::size_t memory_bytes() const;

 private:
  Storage storage_;
  FieldView view_;
};

}  // namespace lockbox
