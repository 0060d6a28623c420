// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/block_averages.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "lockbox/kernels/averaging.hpp"
#include "lockbox/kernels/flatness.hpp"

namespace lockbox {
namespace {

constexpr int kCellSize = SamplingDensity::kCellSize;
constexpr float kBend = 1.5e-5F;  // 1 / metre, from pixel to pixel of the view: 0.02 mm at 1.2 m
/// Times the gate: how far off the face may be expected.
constexpr double kReachOfCut = 2.0;
constexpr int kRowsOfCells = 2;                           // of a band
constexpr int kCellsTogether = 4;                         // along a band, for one tile
constexpr std::size_t kWellFilled = 2 * kernels::kLanes;  // points: enough for a tile of their own
/// Rows of the camera that a mean is taken of, evenly apart. Noise goes together over a few pixels:
/// rows in between tell hardly more, but take most of the time.
constexpr std::size_t kRowsOfMean = 8;

/// Pixels of a cell, one bit each: row by row, eight a row.
using CellMask = std::uint64_t;

constexpr CellMask block_of(int u, int v, int size) {
  constexpr CellMask kFirstColumn = 0x0101010101010101;  // a bit in each row
  const CellMask row = (CellMask{1} << size) - 1;
  const CellMask rows =
      size == kCellSize ? kFirstColumn : kFirstColumn & ((CellMask{1} << (8 * size)) - 1);
  return (row * rows) << (8 * v + u);
}

/// The lowest bits of eight bytes.
CellMask gather_bits(const std::uint8_t* bytes) {
  CellMask eight = 0;
  std::memcpy(&eight, bytes, sizeof(eight));
  return (eight * 0x0102040810204080) >> 56;
}

}  // namespace

/// Points of some rows of cells.
class BlockAverages::Band {
 public:
  /// flat: by pixel of the view, rows padded to whole cells.
  void fill(const Scene& scene, const std::vector<std::uint8_t>& flat, int first_row) {
    clear();
    const int end_row = std::min(first_row + kRowsOfCells, scene.density.rows);
    for (int column = 0; column < scene.density.columns; column += kCellsTogether) {
      const int end = std::min(column + kCellsTogether, scene.density.columns);
      for (int row = first_row; row < end_row; ++row) {
        for (int c = column; c < end; ++c) add_cell(scene, flat, c, row);
      }
      if (x_.size() - first_ >= kWellFilled) finish_tile();
    }
    finish_tile();
  }

  std::size_t slots() const { return x_.size(); }

  /// Writes from that slot on, and with the tiles that are its own.
  void write(BlockAverages& points, std::size_t slot, std::size_t tile) const {
    const auto copy = [slot](const auto& from, auto& to) {
      std::copy(from.begin(), from.end(), to.begin() + static_cast<std::ptrdiff_t>(slot));
    };
    copy(x_, points.x_);
    copy(y_, points.y_);
    copy(z_, points.z_);
    copy(pixel_, points.pixel_);
    copy(averaged_pixels_, points.averaged_pixels_);
    for (Tile own : tiles_) {
      own.first += slot;
      points.tiles_[tile++] = own;
    }
  }

  std::size_t tiles() const { return tiles_.size(); }

 private:
  void clear() {
    for (auto* axis : {&x_, &y_, &z_, &averaged_pixels_}) axis->clear();
    pixel_.clear();
    tiles_.clear();
    first_ = 0;
    pixels_ = 0.0;
    squares_ = 0.0;
    bounds_.setEmpty();
  }

  void add_cell(const Scene& scene, const std::vector<std::uint8_t>& flat, int column, int row) {
    const SamplingDensity& density = scene.density;
    const int spacing =
        density.spacing[static_cast<std::size_t>(row) * static_cast<std::size_t>(density.columns) +
                        static_cast<std::size_t>(column)];
    if (spacing == 0) return;
    u_ = column * kCellSize;
    v_ = row * kCellSize;
    mask_ = 0;
    const auto stride = static_cast<std::size_t>(density.columns) * kCellSize;
    const std::uint8_t* const first =
        flat.data() + static_cast<std::size_t>(v_) * stride + static_cast<std::size_t>(u_);
    for (int i = 0; i < kCellSize; ++i) {
      mask_ |= gather_bits(first + static_cast<std::size_t>(i) * stride) << (8 * i);
    }
    split(scene, 0, 0, kCellSize, std::max(spacing, scene.least_spacing));
  }

  /// A block of the cell.
  void split(const Scene& scene, int u, int v, int size, int smallest) {
    const CellMask block = block_of(u, v, size);
    if ((mask_ & block) == block) {
      add_mean(scene, u_ + u, v_ + v, size);
    } else if (size > smallest) {
      const int half = size / 2;
      for (const int dv : {0, half}) {
        for (const int du : {0, half}) split(scene, u + du, v + dv, half, smallest);
      }
    } else {
      add_pixel_of(scene, mask_ & block, u, v, size);
    }
  }

  /// Adds, of a block that is not all flat, the pixel in its middle, or another of its flat ones,
  /// for all that may be taken for it.
  void add_pixel_of(const Scene& scene, CellMask flat, int u, int v, int size) {
    const int middle = SamplingDensity::first_sample(size);
    int at_u = u + middle;
    int at_v = v + middle;
    if (flat != 0 && (flat & block_of(at_u, at_v, 1)) == 0) {
      const int first = std::countr_zero(flat);
      at_u = first % kCellSize;
      at_v = first / kCellSize;
    }
    const Pixel at = scene.surface.camera_pixel(u_ + at_u, v_ + at_v);
    const PinholeCamera& camera = scene.cloud.camera();
    if (at.u >= camera.width || at.v >= camera.height) return;
    const float z =
        scene.cloud
            .depth()[static_cast<std::size_t>(at.v) * static_cast<std::size_t>(camera.width) +
                     static_cast<std::size_t>(at.u)];
    if (!(z > 0.0F)) return;
    const int alike =
        scene.surface.goes_on(u_ + u, v_ + v, size) ? size * size : std::popcount(flat);
    const int pixels = alike * scene.density.scale * scene.density.scale;
    add(camera, at.u, at.v, z, static_cast<float>(std::max(1, pixels)));
  }

  /// Adds the mean on the ray of the pixel in the middle, as far from the face as the pixels are in
  /// the mean.
  void add_mean(const Scene& scene, int u, int v, int size) {
    const VisibleSurface& surface = scene.surface;
    const RenderedDepth& view = surface.view();
    const int u0 = u + size / 2;
    const int v0 = v + size / 2;
    const std::size_t at = view.index(u0, v0);
    const auto nearness = [&](std::size_t pixel) { return 1.0F / view.depth[pixel]; };
    const auto width = static_cast<std::size_t>(view.width);
    const int scale = scene.density.scale;
    const float per_pixel = 0.5F / static_cast<float>(scale);
    const float per_column = per_pixel * (nearness(at + 1) - nearness(at - 1));
    const float per_row = per_pixel * (nearness(at + width) - nearness(at - width));
    const Pixel middle = surface.camera_pixel(u0, v0);
    const float expected = view.depth[at];
    const float first = 1.0F / expected - per_column * static_cast<float>(middle.u - u * scale) -
                        per_row * static_cast<float>(middle.v - v * scale);
    const PinholeCamera& camera = scene.cloud.camera();
    const auto stride = static_cast<std::size_t>(camera.width);
    const auto side = static_cast<std::size_t>(size) * static_cast<std::size_t>(scale);
    const float* const depths = scene.cloud.depth().data() +
                                static_cast<std::size_t>(v * scale) * stride +
                                static_cast<std::size_t>(u * scale);
    const auto depth = static_cast<double>(expected);
    const double sigma = scene.options.noise.sigma_z(depth) / depth;
    const double gate = scene.options.gate * sigma;
    const std::size_t apart = std::max<std::size_t>(1, side / kRowsOfMean);
    const auto rows = static_cast<float>(apart);
    const kernels::AveragedDeviation found = kernels::average_deviations(
        {depths, apart * stride, side, side / apart}, {first, per_column, rows * per_row},
        static_cast<float>(kReachOfCut * gate), static_cast<float>(gate));
    if (found.pixels == 0.0F) return;
    const float pixels = rows * found.pixels;
    add(camera, middle.u, middle.v, expected * (1.0F + found.mean), pixels);
    squares_ += static_cast<double>(pixels * found.variance) / (sigma * sigma);
  }

  void add(const PinholeCamera& camera, int u, int v, float z, float averaged_pixels) {
    if (x_.size() - first_ == kTilePoints) finish_tile();
    const Eigen::Vector3f p = camera.back_project(u, v, static_cast<double>(z)).cast<float>();
    x_.push_back(p.x());
    y_.push_back(p.y());
    z_.push_back(p.z());
    pixel_.push_back(static_cast<std::uint32_t>(v * camera.width + u));
    averaged_pixels_.push_back(averaged_pixels);
    bounds_.extend(p);
    pixels_ += static_cast<double>(averaged_pixels);
  }

  void finish_tile() {
    const std::size_t count = x_.size() - first_;
    if (count == 0) return;
    Tile tile;
    tile.first = first_;
    tile.count = count;
    tile.padded = kernels::padded(count);
    tile.bounds = bounds_;
    tile.scatter = squares_ / pixels_;
    tiles_.push_back(tile);
    first_ += tile.padded;
    for (auto* axis : {&x_, &y_, &z_}) axis->resize(first_, kernels::kPadding);
    pixel_.resize(first_, 0);
    averaged_pixels_.resize(first_, 0.0F);
    bounds_.setEmpty();
    squares_ = 0.0;
    pixels_ = 0.0;
  }

  std::vector<float> x_, y_, z_, averaged_pixels_;
  std::vector<std::uint32_t> pixel_;
  std::vector<Tile> tiles_;
  std::size_t first_ = 0;  ///< slot of the tile in hand
  Eigen::AlignedBox3f bounds_;
  double pixels_ = 0.0;   ///< of the tile in hand
  double squares_ = 0.0;  ///< the same: of deviations from the means, whitened
  int u_ = 0;             ///< the cell's first pixel of the view
  int v_ = 0;
  CellMask mask_ = 0;  ///< which of its pixels are flat
};

BlockAverages::BlockAverages() : bands_(std::make_unique<std::vector<Band>>()) {}
BlockAverages::~BlockAverages() = default;
BlockAverages::BlockAverages(BlockAverages&&) noexcept = default;
BlockAverages& BlockAverages::operator=(BlockAverages&&) noexcept = default;

/// Pixels at the border of the view have no neighbours, and are not.
void BlockAverages::find_flat(const RenderedDepth& view, int row_of_cells) {
  const auto stride = flat_.size() / static_cast<std::size_t>((view.height + kCellSize - 1) /
                                                              kCellSize * kCellSize);
  const ImageWindow& drawn = view.drawn;
  const int first_row = row_of_cells * kCellSize;
  std::fill_n(
      flat_.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(first_row) * stride),
      static_cast<std::size_t>(kCellSize) * stride, std::uint8_t{0});
  const auto first = static_cast<std::size_t>(std::max(drawn.left, 1));
  const auto end = static_cast<std::size_t>(std::max(std::min(drawn.right(), view.width - 1), 0));
  if (first >= end) return;
  const int end_row = std::min({first_row + kCellSize, drawn.bottom(), view.height - 1});
  for (int v = std::max({first_row, drawn.top, 1}); v < end_row; ++v) {
    const float* const z = view.depth.data() + view.index(0, v);
    const std::int16_t* const id = view.id.data() + view.index(0, v);
    kernels::find_flat({z - view.width, z, z + view.width}, {id - view.width, id, id + view.width},
                       first, end, kBend,
                       flat_.data() + static_cast<std::size_t>(v) * stride + first);
  }
}

void BlockAverages::begin(const SamplingDensity& density) {
  flat_.resize(static_cast<std::size_t>(density.columns * kCellSize) *
               static_cast<std::size_t>(density.rows * kCellSize));
  bands_->resize(static_cast<std::size_t>((density.rows + kRowsOfCells - 1) / kRowsOfCells));
}

std::size_t BlockAverages::bands() const {
  return bands_->size();
}

void BlockAverages::fill_band(const Scene& scene, std::size_t i) {
  const int first_row = static_cast<int>(i) * kRowsOfCells;
  const int end_row = std::min(first_row + kRowsOfCells, scene.density.rows);
  for (int row = first_row; row < end_row; ++row) find_flat(scene.surface.view(), row);
  (*bands_)[i].fill(scene, flat_, first_row);
}

void BlockAverages::finish() {
  std::size_t slots = 0;
  std::size_t tiles = 0;
  for (const Band& band : *bands_) {
    slots += band.slots();
    tiles += band.tiles();
  }
  for (auto* axis : {&x_, &y_, &z_, &averaged_pixels_}) axis->resize(slots);
  pixel_.resize(slots);
  tiles_.resize(tiles);
  slots = tiles = 0;
  for (const Band& band : *bands_) {
    band.write(*this, slots, tiles);
    slots += band.slots();
    tiles += band.tiles();
  }
}

}  // namespace lockbox
