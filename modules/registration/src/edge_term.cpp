// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/edge_term.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "edge_worker.hpp"
#include "lockbox/kernels/flatness.hpp"
#include "lockbox/rendering/body_item.hpp"

namespace lockbox {
namespace {

using Index = Eigen::Index;

constexpr int kMargin = 3;               // pixels around the tiles, into which theirs look
constexpr std::size_t kLeastPixels = 3;  // of a tile
constexpr double kNearest = 0.05;        // metres: what comes nearer to the camera fills the image
/// Bends of less than this many standard deviations of a pixel's own error tell nothing.
constexpr float kLeastBend = 0.1F;

constexpr int kSide = EdgeTile::kSide;
constexpr int kSamples = EdgeTile::kSamples;

std::size_t index(const Pixel& pixel, const PinholeCamera& camera) {
  return static_cast<std::size_t>(pixel.v) * static_cast<std::size_t>(camera.width) +
         static_cast<std::size_t>(pixel.u);
}

}  // namespace

int EdgeTerm::Crop::width() const {
  return 2 * kMargin + kSide * tile_columns;
}

int EdgeTerm::Crop::height() const {
  return 2 * kMargin + kSide * tile_rows;
}

EdgeTerm::EdgeTerm(const KinematicTree& tree, const RegistrationOptions& options,
                   const Executor& executor)
    : tree_(tree),
      options_(options),
      executor_(executor),
      renderer_(std::make_unique<DepthRenderer>(PinholeCamera{}, executor)),
      sample_renderer_(std::make_unique<DepthRenderer>(PinholeCamera{}, executor)) {
  for (const Body& body : tree.bodies) boxes_.push_back(bounds(body.mesh));
  for (int i = 0; i < executor.threads(); ++i) {
    workers_.push_back(std::make_unique<Worker>(options.noise, 6 + tree.variables()));
  }
  information_.setZero(6 + tree.variables(), 6 + tree.variables());
  gradient_.setZero(6 + tree.variables());
}

EdgeTerm::~EdgeTerm() = default;
EdgeTerm::EdgeTerm(EdgeTerm&&) noexcept = default;

void EdgeTerm::linearize(const TiledCloud& cloud,
                         const std::vector<Eigen::Isometry3d>& T_camera_body,
                         const std::vector<BodyJacobian>& jacobians) {
  information_.setZero();
  gradient_.setZero();
  pixels_ = 0.0;
  chi_squared_ = 0.0;
  if (!crop_to_model(cloud.camera(), T_camera_body)) return;
  render(cloud.camera(), T_camera_body);
  express_in_camera(T_camera_body, jacobians);
  find_bends();
  const auto rows = static_cast<std::size_t>(crop_.tile_rows);
  rows_.resize(std::max(rows_.size(), rows));  // more are kept for later frames
  executor_.for_each(rows, [&](std::size_t row) {
    sum_row(cloud, kMargin + kSide * static_cast<int>(row), rows_[row]);
  });
  sum_up(T_camera_body.front());
}

/// False if nothing of the model is in the image.
bool EdgeTerm::crop_to_model(const PinholeCamera& camera,
                             const std::vector<Eigen::Isometry3d>& T_camera_body) {
  const Eigen::AlignedBox2d image(Eigen::Vector2d::Zero(),
                                  Eigen::Vector2d(camera.width, camera.height));
  Eigen::AlignedBox2d seen;
  for (std::size_t b = 0; b < boxes_.size(); ++b) {
    for (int corner = 0; corner < 8 && !boxes_[b].isEmpty(); ++corner) {
      const Eigen::Vector3d p =
          T_camera_body[b] * boxes_[b].corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
      if (!p.allFinite()) return false;
      if (p.z() >= kNearest) {
        seen.extend(camera.project(p));
      } else {
        seen.extend(image);
      }
    }
  }
  const Eigen::AlignedBox2d shown = image.intersection(seen);
  if (shown.isEmpty()) return false;
  const auto whole_tiles = [](double from, double to) {
    return static_cast<int>((to - from) / kSide) + 1;
  };
  crop_.left = static_cast<int>(shown.min().x()) - kMargin;
  crop_.top = static_cast<int>(shown.min().y()) - kMargin;
  crop_.tile_columns = whole_tiles(crop_.left, shown.max().x());
  crop_.tile_rows = whole_tiles(crop_.top, shown.max().y());
  return true;
}

void EdgeTerm::render(const PinholeCamera& camera,
                      const std::vector<Eigen::Isometry3d>& T_camera_body) {
  items_.clear();
  for (std::size_t b = 0; b < T_camera_body.size(); ++b) {
    items_.push_back(body_item(tree_, b, T_camera_body[b]));
  }
  const PinholeCamera cropped{crop_.width(), crop_.height(),         camera.fx,
                              camera.fy,     camera.cx - crop_.left, camera.cy - crop_.top};
  renderer_->set_camera(cropped);
  renderer_->render(items_, view_);
  sample_renderer_->set_camera(refined(cropped, kSamples));
  sample_renderer_->prepare(items_);
}

/// The windows of these tiles of the row that begins at pixel row `top`.
void EdgeTerm::draw_samples(int first_tile, int end_tile, int top, RenderedDepth& samples) const {
  const auto begin_of_window = [](int pixel) { return kSamples * pixel - EdgeTile::kReach; };
  sample_renderer_->draw(
      {begin_of_window(kMargin + kSide * first_tile), begin_of_window(top),
       kSamples * kSide * (end_tile - first_tile - 1) + EdgeTile::kWindow, EdgeTile::kWindow},
      samples);
}

void EdgeTerm::express_in_camera(const std::vector<Eigen::Isometry3d>& T_camera_body,
                                 const std::vector<BodyJacobian>& jacobians) {
  screws_.resize(jacobians.size());
  variables_.resize(jacobians.size());
  for (std::size_t b = 0; b < jacobians.size(); ++b) {
    screws_[b].noalias() = adjoint(T_camera_body[b]) * jacobians[b];
    variables_[b].clear();
    for (int v = 0; v < tree_.variables(); ++v) {
      if (!jacobians[b].col(6 + v).isZero(0.0)) variables_[b].push_back(v);
    }
  }
}

/// Inverse depth is linear in the image of a plane.
void EdgeTerm::find_bends() {
  const auto width = static_cast<std::size_t>(crop_.width());
  const auto height = static_cast<std::size_t>(crop_.height());
  has_bend_.assign(width * height, 0);
  const float least =
      kLeastBend * static_cast<float>(options_.noise.own_share * options_.noise.depth_quadratic);
  executor_.for_each_chunk(height - 2, kSide, [&](std::size_t begin, std::size_t end, auto) {
    for (std::size_t v = begin + 1; v < end + 1; ++v) {
      const float* const z = view_.depth.data() + v * width;
      kernels::find_bends({z - width, z, z + width}, 1, width - 1, least,
                          &has_bend_[v * width + 1]);
    }
  });
}

/// Those of a tile's pixels that measure an edge of the model before the model.
void EdgeTerm::select(const TiledCloud& cloud, int left, int top, EdgePixels& pixels) const {
  pixels.count = 0;
  const PinholeCamera& camera = cloud.camera();
  for (int v = 0; v < kSide; ++v) {
    std::uint64_t any_in_row = 0;
    static_assert(sizeof(any_in_row) == kSide);
    std::memcpy(&any_in_row, &has_bend_[crop_.index(left, top + v)], kSide);
    for (int u = 0; u < kSide && any_in_row != 0; ++u) {
      if (has_bend_[crop_.index(left + u, top + v)] == 0) continue;
      const Pixel pixel = crop_.pixel(left + u, top + v);
      const bool in_image =
          pixel.u >= 0 && pixel.v >= 0 && pixel.u < camera.width && pixel.v < camera.height;
      if (!in_image) continue;
      const std::size_t i = index(pixel, camera);
      if (!(cloud.depth()[i] > 0.0F) || !cloud.keeps(i)) continue;
      pixels.cells[pixels.count++] = static_cast<std::uint8_t>(v * kSide + u);
    }
  }
}

/// Of the tile in hand, adds the pixels that agree with the model at all.
void EdgeTerm::compare(const TiledCloud& cloud, int left, int top, const EdgePixels& pixels,
                       Worker& worker) const {
  const PinholeCamera& camera = cloud.camera();
  worker.find_variables(variables_);
  worker.noise.clear(static_cast<std::size_t>(worker.residual_column() + 1));
  int last_row = -1;
  for (std::size_t i = 0; i < pixels.count; ++i) {
    const int column = pixels.cells[i] % kSide;
    const int row = pixels.cells[i] / kSide;
    if (worker.tile.may_show_nothing(column, row)) continue;
    const Pixel pixel = crop_.pixel(left + column, top + row);
    if (row != last_row) worker.tile.begin_row(row);
    last_row = row;
    worker.tile.look_at(column);
    const float mean = worker.tile.mean();
    const float residual = 1.0F / cloud.depth()[index(pixel, camera)] - mean;
    const float own = worker.noise.own_variance(mean) + worker.tile.variance();
    const auto cut = static_cast<float>(options_.cut * options_.cut);
    if (residual * residual > cut * (own + worker.noise.shared_variance())) continue;
    const std::span<float> values = worker.noise.add(column, row, own);
    worker.differentiate(pixel, camera, screws_, values);
    values.back() = residual;
  }
}

void EdgeTerm::sum_row(const TiledCloud& cloud, int top, RowSums& sums) {
  const Index unknowns = 6 + tree_.variables();
  sums.products.setZero(unknowns + 1, unknowns + 1);
  sums.pixels = 0.0;
  Worker& worker = *workers_[Executor::worker()];
  std::vector<EdgePixels>& row = worker.row;
  row.resize(static_cast<std::size_t>(crop_.tile_columns));
  for (int tile = 0; tile < crop_.tile_columns; ++tile) {
    select(cloud, kMargin + kSide * tile, top, row[static_cast<std::size_t>(tile)]);
  }
  const auto has_edge = [](const EdgePixels& pixels) { return pixels.count >= kLeastPixels; };
  auto first = std::find_if(row.begin(), row.end(), has_edge);
  while (first != row.end()) {
    const auto end = std::find_if_not(first, row.end(), has_edge);
    sum_tiles(cloud, static_cast<int>(first - row.begin()), static_cast<int>(end - row.begin()),
              top, worker, sums);
    first = std::find_if(end, row.end(), has_edge);
  }
}

/// Neighbours in the worker's row.
void EdgeTerm::sum_tiles(const TiledCloud& cloud, int first, int end, int top, Worker& worker,
                         RowSums& sums) const {
  draw_samples(first, end, top, worker.samples);
  for (int tile = first; tile < end; ++tile) {
    if (!worker.tile.read(worker.samples, kSamples * kSide * (tile - first), 0)) continue;
    compare(cloud, kMargin + kSide * tile, top, worker.row[static_cast<std::size_t>(tile)], worker);
    if (worker.noise.count() < kLeastPixels) continue;
    worker.add_whitened(sums.products);
    sums.pixels += static_cast<double>(worker.noise.count());
  }
}

void EdgeTerm::sum_up(const Eigen::Isometry3d& T_camera_base) {
  const Index unknowns = information_.rows();
  sum_.setZero(unknowns + 1, unknowns + 1);
  for (int row = 0; row < crop_.tile_rows; ++row) {
    sum_ += rows_[static_cast<std::size_t>(row)].products;
    pixels_ += rows_[static_cast<std::size_t>(row)].pixels;
  }
  const Matrix6 to_camera = adjoint(T_camera_base);
  for (Index i = 0; i <= unknowns; ++i) {
    sum_.row(i).head<6>() = (sum_.row(i).head<6>() * to_camera).eval();
  }
  for (Index i = 0; i <= unknowns; ++i) {
    sum_.col(i).head<6>() = (to_camera.transpose() * sum_.col(i).head<6>()).eval();
  }
  chi_squared_ = sum_(unknowns, unknowns);
  // Where the noise is larger than assumed, or less alike.
  const double excess = std::max(1.0, chi_squared_ / std::max(1.0, pixels_));
  information_ = sum_.topLeftCorner(unknowns, unknowns) / excess;
  gradient_ = -sum_.col(unknowns).head(unknowns) / excess;
}

}  // namespace lockbox
