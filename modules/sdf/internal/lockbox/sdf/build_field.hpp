// SPDX-License-Identifier: BSD-3-Clause
// From a mesh to the signed distance field of the solid that it bounds.
#pragma once

#include "lockbox/core/parallel.hpp"
#include "lockbox/mesh/triangle_mesh.hpp"
#include "lockbox/sdf/signed_distance_field.hpp"

namespace lockbox {

struct FieldOptions {
  /// Metres between fine samples; at most half the thinnest wall. 0: a quarter of the thinnest
  /// wall, from 1 to 4 mm; finer where the enclosed volume would be wrong by 0.75 %; coarser, up to
  /// half the wall, where memory_budget would be exceeded.
  double voxel = 0.0;
  /// Metres that the fine samples reach to both sides of the surface. 0: 20 mm or four voxels, the
  /// larger; four voxels if that is needed to keep the memory_budget, or for a voxel that is given
  /// the memory_limit.
  double band = 0.0;
  /// Metres that the coarse samples reach beyond the bounds.
  double far_reach = 0.5;
  /// Bytes of fine samples; only what is chosen automatically keeps it.
  double memory_budget = 16e6;
  /// Bytes of fine samples and of the table of their blocks that no field exceeds. It decides
  /// whether there is a field, never what is in it.
  double memory_limit = 512e6;

  bool operator==(const FieldOptions&) const = default;
};

/// Stored distances are those to the triangles, at most a thousandth too large, and rounded (by
/// less than 2 um in the fine blocks at voxels up to 5 mm). A point is inside where the winding
/// number exceeds one half, so the solid is the union of all shells; faces buried in it do not
/// count as surface.
///
/// The mesh is welded and oriented first, and small holes are closed (see
/// with_small_holes_closed()). Small gaps are tolerated. Throws InputError for an empty
/// mesh, one of more than 100 m, or with more than about a hundredth of its surface missing, a
/// voxel above half the thinnest wall, invalid options, and, before the memory is taken, a field
/// beyond the memory_limit; the message names no link.
///
/// storage().thickness is the fifth percentile over the surface of the way through the solid along
/// the inward normal, for the shell where it is least. storage().mesh_volume is that of the union:
/// that of all shells less what they share. The same bits for any number of threads.
SignedDistanceField build_field(const TriangleMesh& mesh, const FieldOptions& options,
                                const Executor& executor);

}  // namespace lockbox
