// SPDX-License-Identifier: BSD-3-Clause
#include "fine_grid.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

constexpr double kBytesPerBlock = 2.0 * kBlockVolume;
constexpr double kMostBytes = 512e6;
constexpr double kUsualBand = 0.02;
constexpr double kLeastBandVoxels = 4.0;

/// What a band of this width takes at least: the band on one side of the surface.
double least_bytes(const Solid& solid, double voxel, double band) {
  const double block = kBlockCells * voxel;
  return solid.area() * band / (block * block * block) * kBytesPerBlock;
}

/// Nothing if the blocks would take more than that.
std::optional<FineGrid> make_fine_grid(const Solid& solid, double voxel, double band,
                                       double most_bytes, const Executor& executor) {
  if (least_bytes(solid, voxel, band) > most_bytes) {
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

std::string millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", 1e3 * metres);
  return text;
}

FineGrid choose_fine_grid(const Solid& solid, const FieldOptions& options,
                          const Executor& executor) {
  const bool is_automatic = options.voxel <= 0.0;
  const double coarsest = is_automatic ? 0.5 * solid.thickness() : options.voxel;
  double voxel = is_automatic
                     ? std::min(std::clamp(0.25 * solid.thickness(), 0.001, 0.004), coarsest)
                     : options.voxel;
  const auto band = [&](double usual) {
    return options.band > 0.0 ? options.band : std::max(usual, kLeastBandVoxels * voxel);
  };
  // First a coarser voxel, then a narrower band; more than the budget only if neither helps.
  while (is_automatic) {
    if (auto grid =
            make_fine_grid(solid, voxel, band(kUsualBand), options.memory_budget, executor)) {
      return *std::move(grid);
    }
    if (voxel >= coarsest) {
      break;
    }
    voxel = std::min(1.2 * voxel, coarsest);
  }
  const double last_band = band(is_automatic ? 0.0 : kUsualBand);
  if (auto grid = make_fine_grid(solid, voxel, last_band, kMostBytes, executor)) {
    return *std::move(grid);
  }
  throw InputError("geometry", "a field with a voxel of " + millimetres(voxel) +
                                   " would take more than 512 MB; choose a larger voxel, or "
                                   "thicken walls of " +
                                   millimetres(solid.thickness()));
}

}  // namespace lockbox
