// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/sdf/signed_distance_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace lockbox {
namespace {

using Eigen::Array3f;
using Eigen::Array3i;

/// A cell's eight corner values in metres, x fastest.
using CellCorners = std::array<float, 8>;

struct Strides {
  std::ptrdiff_t y;
  std::ptrdiff_t z;
};

CellCorners read_cell(const std::int16_t* corner, Strides strides, float scale) {
  CellCorners values;
  for (std::ptrdiff_t i = 0; i < 8; ++i) {
    values[static_cast<std::size_t>(i)] =
        scale *
        static_cast<float>(corner[(i & 1) + ((i >> 1) & 1) * strides.y + (i >> 2) * strides.z]);
  }
  return values;
}

/// at: position within the cell, in [0, 1].
DistanceSample interpolate(const CellCorners& c, const Array3f& at, float voxel) {
  const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
  const float x00 = mix(c[0], c[1], at.x());
  const float x10 = mix(c[2], c[3], at.x());
  const float x01 = mix(c[4], c[5], at.x());
  const float x11 = mix(c[6], c[7], at.x());
  const float y0 = mix(x00, x10, at.y());
  const float y1 = mix(x01, x11, at.y());
  const float dx =
      mix(mix(c[1] - c[0], c[3] - c[2], at.y()), mix(c[5] - c[4], c[7] - c[6], at.y()), at.z());
  const float dy = mix(x10 - x00, x11 - x01, at.z());
  return {mix(y0, y1, at.z()), Eigen::Vector3f(dx, dy, y1 - y0) / voxel};
}

DistanceSample sample_coarse(const FieldView& view, const Eigen::Vector3f& p) {
  const Array3i size(view.coarse_size[0], view.coarse_size[1], view.coarse_size[2]);
  const Array3f origin(view.coarse_origin[0], view.coarse_origin[1], view.coarse_origin[2]);
  const Array3f g = (p.array() - origin) / view.coarse_voxel;
  const Array3f clamped = g.max(0.0F).min((size - 1).cast<float>());
  const Array3i cell = clamped.cast<int>().min(size - 2);
  const Strides strides{size.x(), static_cast<std::ptrdiff_t>(size.x()) * size.y()};
  const std::int16_t* corner =
      view.samples + cell.x() + cell.y() * strides.y + cell.z() * strides.z;
  DistanceSample sample = interpolate(read_cell(corner, strides, view.coarse_scale),
                                      clamped - cell.cast<float>(), view.coarse_voxel);
  const Eigen::Vector3f beyond = (view.coarse_voxel * (g - clamped)).matrix();
  const float way = beyond.norm();
  if (way > 0.0F) {
    sample.distance += way;
    sample.gradient = beyond / way;
  }
  return sample;
}

constexpr Strides kBlockStrides{kBlockSamples, kBlockSamples* kBlockSamples};

const std::int16_t* cell_of_block(const FieldView& view, std::int32_t first, const Array3i& cell) {
  return view.samples + first + cell.x() + cell.y() * kBlockStrides.y + cell.z() * kBlockStrides.z;
}

/// Returns the same values with the axis of the steepest change last.
CellCorners steepest_axis_last(const CellCorners& corners) {
  int steepest = 0;
  interpolate(corners, Array3f::Constant(0.5F), 1.0F).gradient.cwiseAbs().maxCoeff(&steepest);
  CellCorners swapped;
  for (int i = 0; i < 8; ++i) {
    const int bits_differ = ((i >> steepest) ^ (i >> 2)) & 1;
    const int j = bits_differ != 0 ? i ^ (1 << steepest) ^ 4 : i;
    swapped[static_cast<std::size_t>(i)] = corners[static_cast<std::size_t>(j)];
  }
  return swapped;
}

/// Interpolates the four values of a unit square at (x, y).
double bilinear(const float* corners, double x, double y) {
  const auto along_x = [&](const float* pair) {
    return static_cast<double>(pair[0]) + x * static_cast<double>(pair[1] - pair[0]);
  };
  const double first = along_x(corners);
  return first + y * (along_x(corners + 2) - first);
}

/// Share of a unit cell where the interpolant is negative: exact along 4 x 4 lines that run across
/// the surface.
double negative_share(const CellCorners& corners) {
  const auto [least, largest] = std::minmax_element(corners.begin(), corners.end());
  if (*least >= 0.0F || *largest <= 0.0F) {
    return *least < 0.0F ? 1.0 : 0.0;
  }
  const CellCorners across = steepest_axis_last(corners);
  constexpr int kLines = 4;
  double share = 0.0;
  for (int i = 0; i < kLines * kLines; ++i) {
    const int row = i / kLines;
    const double x = (i % kLines + 0.5) / kLines;
    const double y = (row + 0.5) / kLines;
    const double low = bilinear(across.data(), x, y);
    const double high = bilinear(across.data() + 4, x, y);
    if ((low < 0.0) != (high < 0.0)) {
      share += std::min(low, high) / (std::min(low, high) - std::max(low, high));
    } else if (low < 0.0) {
      share += 1.0;
    }
  }
  return share / (kLines * kLines);
}

/// Cells of a block where the interpolant is negative.
double negative_cells(const FieldView& view, std::int32_t first) {
  constexpr int kCells = kBlockCells * kBlockCells * kBlockCells;
  const std::int16_t* const samples = view.samples + first;
  const auto [least, largest] = std::minmax_element(samples, samples + kBlockVolume);
  if (*least >= 0) return 0.0;
  if (*largest < 0) return kCells;
  double cells = 0.0;
  for (int i = 0; i < kCells; ++i) {
    const Array3i cell(i % kBlockCells, i / kBlockCells % kBlockCells,
                       i / (kBlockCells * kBlockCells));
    cells +=
        negative_share(read_cell(cell_of_block(view, first, cell), kBlockStrides, view.fine_scale));
  }
  return cells;
}

}  // namespace

SignedDistanceField::SignedDistanceField(Storage storage)
    : storage_(std::move(storage)), view_(storage_.grid) {
  view_.samples = storage_.samples.data();
  view_.block_first = storage_.block_first.data();
}

// A moved vector keeps its memory, so the view stays right.
SignedDistanceField::SignedDistanceField(SignedDistanceField&&) noexcept = default;
SignedDistanceField& SignedDistanceField::operator=(SignedDistanceField&&) noexcept = default;

DistanceSample SignedDistanceField::sample(const Eigen::Vector3f& p) const {
  const Array3f origin(view_.fine_origin[0], view_.fine_origin[1], view_.fine_origin[2]);
  const Array3i blocks(view_.blocks[0], view_.blocks[1], view_.blocks[2]);
  const Array3f g = (p.array() - origin) / view_.fine_voxel;
  if (!g.allFinite()) {
    return {std::numeric_limits<float>::infinity(), Eigen::Vector3f::Zero()};
  }
  if ((g >= 0.0F).all() && (g < (kBlockCells * blocks).cast<float>()).all()) {
    const Array3i cell = g.cast<int>();
    const Array3i block = cell / kBlockCells;
    const std::int32_t first =
        view_.block_first[(block.z() * blocks.y() + block.y()) * blocks.x() + block.x()];
    if (first >= 0) {
      const std::int16_t* corner = cell_of_block(view_, first, cell - kBlockCells * block);
      return interpolate(read_cell(corner, kBlockStrides, view_.fine_scale), g - cell.cast<float>(),
                         view_.fine_voxel);
    }
  }
  return sample_coarse(view_, p);
}

double SignedDistanceField::enclosed_volume() const {
  const Array3f origin(view_.fine_origin[0], view_.fine_origin[1], view_.fine_origin[2]);
  const Array3i blocks(view_.blocks[0], view_.blocks[1], view_.blocks[2]);
  double cells = 0.0;
  for (int i = 0; i < blocks.prod(); ++i) {
    const std::int32_t first = view_.block_first[i];
    if (first >= 0) {
      cells += negative_cells(view_, first);
      continue;
    }
    // No surface comes near a block that is not stored: it is all inside or all outside.
    const Array3i block(i % blocks.x(), i / blocks.x() % blocks.y(), i / (blocks.x() * blocks.y()));
    const Array3f middle = origin + view_.fine_voxel * kBlockCells * (block.cast<float>() + 0.5F);
    if (sample_coarse(view_, middle).distance < 0.0F) {
      cells += kBlockCells * kBlockCells * kBlockCells;
    }
  }
  return cells * std::pow(voxel(), 3);
}

std::size_t SignedDistanceField::memory_bytes() const {
  return sizeof(*this) + storage_.samples.size() * sizeof(std::int16_t) +
         storage_.block_first.size() * sizeof(std::int32_t);
}

}  // namespace lockbox
