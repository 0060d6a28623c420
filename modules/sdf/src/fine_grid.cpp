// SPDX-License-Identifier: BSD-3-Clause
#include "fine_grid.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

constexpr double kBytesPerBlock = 2.0 * kBlockVolume;
/// Of each block of the bounding box, stored or not, while it is decided.
constexpr double kBytesPerPlace = 5.0;
constexpr double kMostBytes = 512e6;
constexpr double kUsualBand = 0.02;
constexpr double kLeastBandVoxels = 4.0;

/// What a band of this width takes at least: the band on one side of the surface.
double least_bytes(const Solid& solid, double voxel, double band) {
  const double block = kBlockCells * voxel;
  return solid.area() * band / (block * block * block) * kBytesPerBlock;
}

/// What the band takes by default, or as the options say.
double band_for(const FieldOptions& options, double usual, double voxel) {
  return options.band > 0.0 ? options.band : std::max(usual, kLeastBandVoxels * voxel);
}

/// Nothing if the blocks would take more than that.
std::optional<FineGrid> make_fine_grid(const Solid& solid, double voxel, double band,
                                       double most_bytes, const Executor& executor) {
  const Eigen::Array3d blocks =
      ((solid.bounds().sizes().array() + 2.0 * band) / (kBlockCells * voxel)).ceil();
  if (least_bytes(solid, voxel, band) > most_bytes || kBytesPerPlace * blocks.prod() > kMostBytes) {
    return std::nullopt;
  }
  FineGrid grid{make_fine_layout(solid.bounds(), voxel, band), {}};
  grid.stored = blocks_near_surface(grid.layout, solid.tree(), executor);
  return grid.bytes() <= most_bytes ? std::optional(std::move(grid)) : std::nullopt;
}

}  // namespace

double FineGrid::bytes() const {
  return kBytesPerBlock * static_cast<double>(stored.size());
}

std::string length_text(double metres) {
  struct Unit {
    double per_metre;
    const char* name;
  };
  constexpr std::array<Unit, 4> kUnits = {{{1.0, " m"}, {1e3, " mm"}, {1e6, " um"}, {1e9, " nm"}}};
  // Tenths of a millimetre are more familiar than micrometres.
  constexpr double kLeastMillimetres = 1e-4;
  const std::size_t unit =
      metres >= 1.0 ? 0 : (metres >= kLeastMillimetres ? 1 : (metres >= 1e-6 ? 2 : 3));
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.2e", kUnits[unit].per_metre * metres);
  return fixed_number_text(parse_number(digits).value_or(metres)) + kUnits[unit].name;
}

std::optional<FineGrid> refined_fine_grid(const Solid& solid, const FieldOptions& options,
                                          double voxel, const Executor& executor) {
  const double band = band_for(options, kUsualBand, voxel);
  return make_fine_grid(solid, voxel, band, options.memory_budget, executor);
}

FineGrid choose_fine_grid(const Solid& solid, const FieldOptions& options,
                          const Executor& executor) {
  const bool is_automatic = options.voxel <= 0.0;
  const double coarsest = 0.5 * solid.thickness();
  double voxel = is_automatic
                     ? std::min(std::clamp(0.25 * solid.thickness(), 0.001, 0.004), coarsest)
                     : options.voxel;
  // First a coarser voxel, then a narrower band; more than the budget only if neither helps.
  while (is_automatic) {
    if (auto grid = refined_fine_grid(solid, options, voxel, executor)) {
      return *std::move(grid);
    }
    if (voxel >= coarsest) {
      break;
    }
    voxel = std::min(1.2 * voxel, coarsest);
  }
  const auto last_grid = [&](double last_voxel) {
    const double band = band_for(options, is_automatic ? 0.0 : kUsualBand, last_voxel);
    return make_fine_grid(solid, last_voxel, band, kMostBytes, executor);
  };
  if (auto grid = last_grid(voxel)) {
    return *std::move(grid);
  }
  if (!is_automatic && last_grid(coarsest)) {
    throw InputError("geometry", "a field with a voxel of " + length_text(voxel) +
                                     " would take more than 512 MB; choose a larger voxel, up to " +
                                     length_text(coarsest) + ", half the thinnest wall");
  }
  throw InputError("geometry",
                   "the thinnest wall, " + length_text(solid.thickness()) +
                       ", is too thin for a body of " +
                       length_text(solid.bounds().diagonal().norm()) +
                       ": a field that is fine enough would take more than 512 MB; thicken such "
                       "walls, or leave them out of the mesh (is its scale right? lengths are in "
                       "metres)");
}

}  // namespace lockbox
