// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/sdf/build_field.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "block_sampler.hpp"
#include "coarse_grid.hpp"
#include "fine_grid.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/readable_text.hpp"

namespace lockbox {
namespace {

using Storage = SignedDistanceField::Storage;

void require_valid(const FieldOptions& options) {
  const auto is_length = [](double value) { return std::isfinite(value) && value >= 0.0; };
  if (!is_length(options.voxel) || !is_length(options.band) || !is_length(options.far_reach) ||
      !is_length(options.memory_budget) || !is_length(options.memory_limit)) {
    throw InputError("field options", "voxel, band, reach, budget and limit must not be negative");
  }
}

void require_fine_enough(double voxel, const Solid& solid) {
  const double coarsest = 0.5 * solid.thickness();
  // The thickness is measured with rays: an equal voxel must not fail by their rounding.
  if (voxel > 1.001 * coarsest) {
    throw InputError("geometry", "a voxel of " + readable_length(voxel) +
                                     " is more than half the thinnest wall; choose " +
                                     readable_length(coarsest) + " or less");
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

Storage store_coarse(const CoarseGrid& coarse, const Solid& solid) {
  Storage storage;
  storage.bounds = solid.bounds();
  storage.mesh_volume = solid.surface().volume;
  storage.thickness = solid.thickness();
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
  return storage;
}

/// Appends the fine blocks and the spare sample to a storage with the coarse grid.
SignedDistanceField with_fine_grid(Storage storage, const FineGrid& fine, const Solid& solid,
                                   const Executor& executor) {
  const FineLayout& layout = fine.layout;
  const double scale = scale_for(layout.largest_distance());
  const std::size_t first = storage.samples.size();
  storage.block_first.assign(layout.block_count(), -1);
  storage.samples.resize(first + fine.stored.size() * kBlockVolume + 1, 0);
  const auto open = solid.open_slots();
  const auto sample_chunk = [&](std::size_t begin, std::size_t end, std::size_t) {
    BlockSampler sampler(layout, solid.tree(), solid.winding(), open);
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
  return SignedDistanceField(std::move(storage));
}

double volume_error(const SignedDistanceField& field) {
  return std::abs(field.enclosed_volume() / field.storage().mesh_volume - 1.0);
}

}  // namespace

SignedDistanceField build_field(const TriangleMesh& mesh, const FieldOptions& options,
                                const Executor& executor) {
  require_valid(options);
  const Solid solid(mesh, executor);
  require_fine_enough(options.voxel, solid);
  const Storage coarse = store_coarse(
      sample_coarse_grid(solid.tree(), solid.winding(), options.far_reach, executor), solid);
  const FineGrid first = choose_fine_grid(solid, options, executor);
  SignedDistanceField field = with_fine_grid(coarse, first, solid, executor);
  if (options.voxel > 0.0) {
    return field;
  }
  // Interpolation rounds sharp edges off, by a volume that falls with the voxel's square; on small
  // bodies that counts.
  constexpr double kMostError = 0.0075;
  constexpr double kAimedError = 0.005;
  constexpr int kMostTries = 3;
  double error = volume_error(field);
  for (int i = 0; i < kMostTries && error > kMostError; ++i) {
    const double finer = field.voxel() * std::max(0.25, std::sqrt(kAimedError / error));
    const auto grid = grid_within_budget(solid, finer, options, executor);
    if (!grid) {
      break;
    }
    field = with_fine_grid(coarse, *grid, solid, executor);
    const double previous = std::exchange(error, volume_error(field));
    if (error > 0.8 * previous) {
      break;  // not a matter of the voxel: a mesh with gaps has no exact volume
    }
  }
  return field;
}

}  // namespace lockbox
