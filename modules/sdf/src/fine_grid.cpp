// SPDX-License-Identifier: BSD-3-Clause
#include "fine_grid.hpp"

#include <algorithm>
#include <string>

#include "lockbox/core/error.hpp"
#include "lockbox/core/readable_text.hpp"

namespace lockbox {
namespace {

constexpr double kBytesPerBlock = 2.0 * kBlockVolume;
constexpr double kTableBytesPerBlock = 5.0;  // its entry, and whether it is near the surface
// A larger table asks for a coarser voxel: bodies of sparse parts, such as tripods, have one. Twice
// as many bytes keep the voxel in a body that is larger by a quarter.
constexpr double kMostTableBytes = 64e6;
constexpr double kUsualBand = 0.02;
constexpr double kLeastBandVoxels = 4.0;

double band_of(const FieldOptions& options, double usual, double voxel) {
  return options.band > 0.0 ? options.band : std::max(usual, kLeastBandVoxels * voxel);
}

/// What a band of this width takes at least: the band on one side of the surface.
double least_bytes(const Solid& solid, double voxel, double band) {
  const double block = kBlockCells * voxel;
  return solid.area() * band / (block * block * block) * kBytesPerBlock;
}

/// Returns the size of the table of all blocks within the bounds. A small surface that reaches far
/// has a large one.
double table_bytes(const Solid& solid, double voxel, double band) {
  const Eigen::Array3d covered = solid.bounds().sizes().array() + 2.0 * band;
  return (covered / (kBlockCells * voxel) + 1.0).prod() * kTableBytesPerBlock;
}

/// Nothing if the blocks, or their table, would take more than that.
std::optional<FineGrid> make_fine_grid(const Solid& solid, double voxel, double band,
                                       double most_bytes, double most_table_bytes,
                                       const Executor& executor) {
  if (table_bytes(solid, voxel, band) > most_table_bytes ||
      least_bytes(solid, voxel, band) > most_bytes) {
    return std::nullopt;
  }
  FineGrid grid{make_fine_layout(solid.bounds(), voxel, band), {}};
  grid.stored = blocks_near_surface(grid.layout, solid.tree(), executor);
  return grid.bytes() <= most_bytes ? std::optional(std::move(grid)) : std::nullopt;
}

/// Nothing if blocks and table together would take more than the limit.
std::optional<FineGrid> grid_within_limit(const Solid& solid, double voxel, double usual_band,
                                          const FieldOptions& options, const Executor& executor) {
  const double band = band_of(options, usual_band, voxel);
  const double table = table_bytes(solid, voxel, band);
  return make_fine_grid(solid, voxel, band, options.memory_limit - table, options.memory_limit,
                        executor);
}

/// A voxel, not finer than the given one, whose field keeps the limit for sure.
double affordable_voxel(const Solid& solid, double voxel, const FieldOptions& options) {
  constexpr double kStep = 1.05;
  constexpr double kMostOfLeast = 8.0;  // both sides, whole blocks at their borders, and edges
  const double coarsest = solid.bounds().diagonal().norm();
  const auto bytes = [&] {
    const double band = band_of(options, 0.0, voxel);
    return kMostOfLeast * least_bytes(solid, voxel, band) + table_bytes(solid, voxel, band);
  };
  while (voxel < coarsest && bytes() > options.memory_limit) voxel *= kStep;
  return voxel;
}

[[noreturn]] void refuse(const Solid& solid, double voxel, const FieldOptions& options) {
  const double affordable = affordable_voxel(solid, voxel, options);
  const std::string problem = "a field with a voxel of " + readable_length(voxel) +
                              " would take more than the limit of " +
                              readable_number(1e-6 * options.memory_limit) + " MB; ";
  if (affordable <= 0.5 * solid.thickness()) {
    throw InputError("geometry", problem + "choose a voxel of " + readable_length(affordable) +
                                     " to " + readable_length(0.5 * solid.thickness()));
  }
  throw InputError("geometry", problem + "its walls of " + readable_length(solid.thickness()) +
                                   " allow none that is coarser: over a link that is " +
                                   readable_length(solid.bounds().sizes().maxCoeff()) +
                                   " large, thicken them to " + readable_length(2.0 * affordable) +
                                   " or more, or divide the link into several bodies");
}

}  // namespace

double FineGrid::bytes() const {
  return kBytesPerBlock * static_cast<double>(stored.size());
}

std::optional<FineGrid> grid_within_budget(const Solid& solid, double voxel,
                                           const FieldOptions& options, const Executor& executor) {
  return make_fine_grid(solid, voxel, band_of(options, kUsualBand, voxel), options.memory_budget,
                        kMostTableBytes, executor);
}

FineGrid choose_fine_grid(const Solid& solid, const FieldOptions& options,
                          const Executor& executor) {
  const bool is_automatic = options.voxel <= 0.0;
  const double coarsest = is_automatic ? 0.5 * solid.thickness() : options.voxel;
  double voxel = is_automatic
                     ? std::min(std::clamp(0.25 * solid.thickness(), 0.001, 0.004), coarsest)
                     : options.voxel;
  // First a coarser voxel, then a narrower band; more than the budget only if neither helps.
  std::optional<FineGrid> grid;
  while (is_automatic) {
    grid = grid_within_budget(solid, voxel, options, executor);
    if (grid || voxel >= coarsest) break;
    voxel = std::min(1.2 * voxel, coarsest);
  }
  if (!is_automatic) grid = grid_within_limit(solid, voxel, kUsualBand, options, executor);
  if (!grid) grid = grid_within_limit(solid, voxel, 0.0, options, executor);
  if (!grid || grid->bytes() > options.memory_limit) refuse(solid, voxel, options);
  return *std::move(grid);
}

}  // namespace lockbox
