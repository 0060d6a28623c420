// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/sdf/build_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "block_sampler.hpp"
#include "coarse_grid.hpp"
#include "fine_layout.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/mesh/repair.hpp"
#include "lockbox/mesh/topology.hpp"
#include "outer_surface.hpp"
#include "wall_thickness.hpp"

namespace lockbox {
namespace {

constexpr double kBytesPerBlock = 2.0 * kBlockVolume;
constexpr double kMostBytes = 512e6;
constexpr double kLeastBand = 0.02;
constexpr double kBandVoxels = 4.0;

std::string millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", 1e3 * metres);
  return text;
}

void require_valid(const TriangleMesh& mesh, const FieldOptions& options) {
  const auto is_length = [](double value) { return std::isfinite(value) && value >= 0.0; };
  if (!is_length(options.voxel) || !is_length(options.band) || !is_length(options.far_reach)) {
    throw InputError("field options", "voxel, band and reach must be lengths, not negative");
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      if (vertex >= mesh.vertices.size() || !mesh.vertices[vertex].allFinite()) {
        throw InputError("geometry", "a triangle has a corner that is missing or not finite");
      }
    }
  }
}

/// Welded and oriented, or refused.
TriangleMesh mended(const TriangleMesh& mesh) {
  TriangleMesh result = oriented_outwards(welded(mesh));
  if (result.triangles.empty()) {
    throw InputError("geometry", "the mesh has no triangle with an area");
  }
  return result;
}

OuterSurface closed_surface(const TriangleMesh& mesh, const WindingTree& winding) {
  constexpr double kMostOpen = 0.01;
  const double share = open_share(mesh, winding);
  if (share > kMostOpen) {
    char percent[16];
    std::snprintf(percent, sizeof percent, "%.2g %%", 100.0 * share);
    throw InputError("geometry", std::string("the surface is open: about ") + percent +
                                     " of it is missing or faces the wrong way, so that inside "
                                     "and outside are not defined; close the mesh");
  }
  return find_outer_surface(mesh, winding);
}

/// A mesh made ready: what its distances and signs are computed from.
struct Solid {
  explicit Solid(const TriangleMesh& input)
      : mesh(mended(input)),
        winding(mesh),
        surface(closed_surface(mesh, winding)),
        tree(surface.mesh),
        thickness(thinnest_wall(surface, tree, mesh, winding)) {}

  /// For each slot of the tree, whether its triangle is at an open edge.
  std::vector<std::uint8_t> open_slots() const {
    const auto open = triangles_at_open_edges(mesh);
    std::vector<std::uint8_t> slots;
    for (std::uint32_t slot = 0; slot < tree.corners().size(); ++slot) {
      slots.push_back(open[surface.source[tree.triangle_of(slot)]]);
    }
    return slots;
  }

  TriangleMesh mesh;
  WindingTree winding;
  OuterSurface surface;
  TriangleTree tree;
  double thickness;
};

struct FineGrid {
  FineLayout layout;
  std::vector<std::size_t> stored;  ///< numbers of the blocks
};

/// What a band of this width takes at least: the band on one side of the surface.
double least_bytes(const Solid& solid, double voxel, double band) {
  const double block = kBlockCells * voxel;
  return surface_area(solid.surface.mesh) * band / (block * block * block) * kBytesPerBlock;
}

/// The finest that keeps the budget; if none does, the smallest that is allowed.
FineGrid choose_fine_grid(const Solid& solid, const FieldOptions& options,
                          const Executor& executor) {
  const bool is_automatic = options.voxel <= 0.0;
  const double coarsest = 0.5 * solid.thickness;
  double voxel = is_automatic ? std::min(std::clamp(0.25 * solid.thickness, 0.001, 0.004), coarsest)
                              : options.voxel;
  bool is_narrow = false;
  while (true) {
    const double narrow = kBandVoxels * voxel;
    const double band =
        options.band > 0.0 ? options.band : (is_narrow ? narrow : std::max(kLeastBand, narrow));
    const double least = least_bytes(solid, voxel, band);
    const bool may_shrink = is_automatic && (voxel < coarsest || !is_narrow);
    if (least <= options.memory_budget || (!may_shrink && least <= kMostBytes)) {
      FineGrid grid{make_fine_layout(solid.tree.nodes().front().box, voxel, band), {}};
      grid.stored = blocks_near_surface(grid.layout, solid.tree, executor);
      const double bytes = kBytesPerBlock * static_cast<double>(grid.stored.size());
      if (bytes <= options.memory_budget || (!may_shrink && bytes <= kMostBytes)) {
        return grid;
      }
    }
    if (!may_shrink) {
      throw InputError("geometry", "a field with a voxel of " + millimetres(voxel) +
                                       " would take more than 512 MB; choose a larger voxel");
    }
    if (voxel < coarsest) {
      voxel = std::min(1.2 * voxel, coarsest);
    } else {
      is_narrow = true;
    }
  }
}

std::int16_t quantized(double distance, double scale) {
  return static_cast<std::int16_t>(std::lround(distance / scale));
}

/// Metres a unit, exactly a float, so that the largest distance just fits.
double scale_for(double largest_distance) {
  return static_cast<double>(static_cast<float>(1.0001 * largest_distance / 32767.0));
}

template <typename T>
void copy_to(const Eigen::Matrix<T, 3, 1>& from, T (&to)[3]) {
  std::copy(from.data(), from.data() + 3, to);
}

void store_coarse(const CoarseGrid& coarse, SignedDistanceField::Storage& storage) {
  double largest = 0.0;
  for (const double distance : coarse.distances) {
    largest = std::max(largest, std::abs(distance));
  }
  const double scale = scale_for(largest);
  for (const double distance : coarse.distances) {
    storage.samples.push_back(quantized(distance, scale));
  }
  FieldView& grid = storage.grid;
  grid.coarse_scale = static_cast<float>(scale);
  grid.coarse_voxel = static_cast<float>(coarse.voxel);
  copy_to<float>(coarse.origin.cast<float>(), grid.coarse_origin);
  copy_to<std::int32_t>(coarse.size, grid.coarse_size);
}

void store_fine(const FineGrid& fine, const Solid& solid, const Executor& executor,
                SignedDistanceField::Storage& storage) {
  const FineLayout& layout = fine.layout;
  const double scale = scale_for(layout.largest_distance());
  const std::size_t first = storage.samples.size();
  storage.block_first.assign(layout.block_count(), -1);
  storage.samples.resize(first + fine.stored.size() * kBlockVolume);
  const auto open = solid.open_slots();
  const auto sample_chunk = [&](std::size_t begin, std::size_t end, std::size_t) {
    BlockSampler sampler(layout, solid.tree, solid.winding, open);
    for (std::size_t i = begin; i < end; ++i) {
      std::size_t next = first + i * kBlockVolume;
      storage.block_first[fine.stored[i]] = static_cast<std::int32_t>(next);
      for (const double distance : sampler.sample(fine.stored[i])) {
        storage.samples[next++] = quantized(distance, scale);
      }
    }
  };
  executor.for_each_chunk(fine.stored.size(), 8, sample_chunk);
  FieldView& grid = storage.grid;
  grid.fine_scale = static_cast<float>(scale);
  grid.fine_voxel = static_cast<float>(layout.voxel);
  copy_to<float>(layout.origin.cast<float>(), grid.fine_origin);
  copy_to<std::int32_t>(layout.blocks, grid.blocks);
}

}  // namespace

SignedDistanceField build_field(const TriangleMesh& mesh, const FieldOptions& options,
                                const Executor& executor) {
  require_valid(mesh, options);
  const Solid solid(mesh);
  if (options.voxel > 0.5 * solid.thickness) {
    throw InputError("geometry", "a voxel of " + millimetres(options.voxel) +
                                     " is more than half the thinnest wall (" +
                                     millimetres(solid.thickness) + "); choose " +
                                     millimetres(0.5 * solid.thickness) + " or less");
  }
  SignedDistanceField::Storage storage;
  storage.bounds = solid.tree.nodes().front().box;
  storage.mesh_volume = solid.surface.volume;
  storage.thickness = solid.thickness;
  store_coarse(sample_coarse_grid(solid.tree, solid.winding, options.far_reach, executor), storage);
  store_fine(choose_fine_grid(solid, options, executor), solid, executor, storage);
  storage.samples.push_back(0);
  return SignedDistanceField(std::move(storage));
}

}  // namespace lockbox
