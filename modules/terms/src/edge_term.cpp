// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/edge_term.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>

#include "edge_worker.hpp"
#include "lockbox/rendering/body_item.hpp"

namespace lockbox {
namespace {

using Index = Eigen::Index;

constexpr int kMargin = 2;               // pixels around the image, into which patches look
constexpr std::size_t kLeastPixels = 3;  // of a patch
/// Tiles: few enough that what is drawn of them stays in the cache, enough that windows overlap
/// little.
constexpr std::size_t kMostInStrip = 16;
/// Bends of less than this many standard deviations of a pixel's own error tell nothing.
constexpr double kLeastBend = 0.1;

constexpr int kSide = EdgePatch::kSide;
constexpr int kSamples = EdgePatch::kSamples;

std::size_t index(const Pixel& pixel, const PinholeCamera& camera) {
  return static_cast<std::size_t>(pixel.v) * static_cast<std::size_t>(camera.width) +
         static_cast<std::size_t>(pixel.u);
}

}  // namespace

EdgeTerm::EdgeTerm(const KinematicTree& tree, const ViewOptions& options, const Executor& executor)
    : tree_(tree),
      options_(options),
      executor_(executor),
      least_bend_(
          static_cast<float>(kLeastBend * options.noise.own_share * options.noise.depth_quadratic)),
      sample_renderer_(std::make_unique<DepthRenderer>(PinholeCamera{}, executor)) {
  for (int i = 0; i < executor.threads(); ++i) {
    workers_.push_back(std::make_unique<Worker>(options.noise, tree.unknowns()));
  }
  information_.setZero(tree.unknowns(), tree.unknowns());
  gradient_.setZero(tree.unknowns());
}

EdgeTerm::~EdgeTerm() = default;
EdgeTerm::EdgeTerm(EdgeTerm&&) noexcept = default;

void EdgeTerm::linearize(const TiledCloud& cloud, const VisibleSurface& view,
                         const ContinuedEdges& continued, std::size_t patches_per_joint,
                         const BodyPoses& T_camera_body,
                         const std::vector<BodyJacobian>& jacobians) {
  view_ = &view;
  continued_ = &continued;
  prepare(cloud.camera(), T_camera_body);
  express_in_camera(T_camera_body, jacobians);
  selection_.select(view, cloud.camera(), least_bend_, executor_);
  if (patches_per_joint != kAllPatches && tree_.variables() > 0) {
    const double sigma = options_.noise.depth_quadratic;
    selection_.keep_best(view, screws_, variables_, static_cast<float>(sigma * sigma),
                         patches_per_joint, executor_);
  }
  cut_into_strips();
  executor_.for_each(strip_count_, [&](std::size_t i) { sum_strip(cloud, strips_[i]); });
  sum_up(T_camera_body.front());
}

void EdgeTerm::prepare(const PinholeCamera& camera, const BodyPoses& T_camera_body) {
  items_.clear();
  for (std::size_t b = 0; b < T_camera_body.size(); ++b) {
    items_.push_back(body_item(tree_, b, T_camera_body[b]));
  }
  const auto whole_patches = [](int pixels) { return (pixels + kSide - 1) / kSide * kSide; };
  const PinholeCamera padded{whole_patches(camera.width) + 2 * kMargin,
                             whole_patches(camera.height) + 2 * kMargin,
                             camera.fx,
                             camera.fy,
                             camera.cx + kMargin,
                             camera.cy + kMargin};
  sample_renderer_->set_camera(refined(padded, kSamples));
  sample_renderer_->prepare(items_);
}

/// The windows of neighbouring patches.
void EdgeTerm::draw_samples(int first_column, int end_column, int row,
                            RenderedInverseDepth& samples) const {
  const auto begin_of_window = [](int patch) {
    return kSamples * (kMargin + kSide * patch) - EdgePatch::kReach;
  };
  sample_renderer_->draw(
      {begin_of_window(first_column), begin_of_window(row),
       kSamples * kSide * (end_column - first_column - 1) + EdgePatch::kWindow, EdgePatch::kWindow},
      samples);
}

void EdgeTerm::express_in_camera(const BodyPoses& T_camera_body,
                                 const std::vector<BodyJacobian>& jacobians) {
  screws_.resize(jacobians.size());
  variables_.resize(jacobians.size());
  for (std::size_t b = 0; b < jacobians.size(); ++b) {
    screws_[b].noalias() = adjoint(T_camera_body[b]) * jacobians[b];
    variables_[b].clear();
    for (int v = 0; v < tree_.variables(); ++v) {
      if (!jacobians[b].col(unknown_of(v)).isZero(0.0)) variables_[b].push_back(v);
    }
  }
}

void EdgeTerm::cut_into_strips() {
  strip_count_ = 0;
  for (std::size_t row = 0; row < selection_.rows(); ++row) {
    for (std::span<const int> rest(selection_.columns(row)); !rest.empty();) {
      if (strip_count_ == strips_.size()) strips_.emplace_back();
      Strip& strip = strips_[strip_count_++];
      strip.row = static_cast<int>(row);
      strip.columns = rest.first(std::min(rest.size(), kMostInStrip));
      rest = rest.subspan(strip.columns.size());
    }
  }
}

void EdgeTerm::sum_strip(const TiledCloud& cloud, Strip& strip) {
  const Index unknowns = tree_.unknowns();
  strip.products.setZero(unknowns + 1, unknowns + 1);
  strip.pixels = 0.0;
  Worker& worker = *workers_[Executor::worker()];
  const std::span<const int> columns = strip.columns;
  for (std::size_t first = 0; first < columns.size();) {
    std::size_t end = first + 1;
    while (end < columns.size() && columns[end] == columns[end - 1] + 1) ++end;
    sum_neighbours(cloud, columns[first], columns[end - 1] + 1, worker, strip);
    first = end;
  }
}

void EdgeTerm::sum_neighbours(const TiledCloud& cloud, int first_column, int end_column,
                              Worker& worker, Strip& strip) const {
  draw_samples(first_column, end_column, strip.row, worker.samples);
  for (int column = first_column; column < end_column; ++column) {
    if (!worker.patch.read(worker.samples, kSamples * kSide * (column - first_column), 0)) continue;
    compare(cloud, {kSide * column, kSide * strip.row}, worker);
    if (worker.noise.count() < kLeastPixels) continue;
    worker.add_whitened(strip.products);
    strip.pixels += static_cast<double>(worker.noise.count());
  }
}

/// Adds the pixels of the patch in hand, whose first pixel is given, that measure an edge of the
/// model before the model and agree with it at all.
void EdgeTerm::compare(const TiledCloud& cloud, const Pixel& first, Worker& worker) const {
  worker.find_variables(variables_, screws_);
  worker.noise.clear(static_cast<std::size_t>(worker.residual_column() + 1));
  const int rows = std::min(kSide, cloud.camera().height - first.v);
  for (int row = 0; row < rows; ++row) {
    find_edges(cloud, first, row, worker);
    if (worker.columns.empty()) continue;
    worker.patch.begin_row(row, worker.columns.front(), worker.columns.back() + 1);
    for (const int column : worker.columns) compare_pixel(cloud, first, column, row, worker);
  }
}

/// The columns of a row of the patch whose pixels measure an edge.
void EdgeTerm::find_edges(const TiledCloud& cloud, const Pixel& first, int row,
                          Worker& worker) const {
  worker.columns.clear();
  const int columns = std::min(kSide, cloud.camera().width - first.u);
  for (auto left = worker.patch.bending(row, least_bend_); left != 0; left &= left - 1) {
    const int column = std::countr_zero(left);
    if (column >= columns) break;
    const std::size_t i = index({first.u + column, first.v + row}, cloud.camera());
    if (!(cloud.depth()[i] > 0.0F) || !cloud.keeps(i)) continue;
    if (continued_->covers(view_->view_pixel(i))) continue;
    if (!worker.patch.may_show_nothing(column, row)) worker.columns.push_back(column);
  }
}

void EdgeTerm::compare_pixel(const TiledCloud& cloud, const Pixel& first, int column, int row,
                             Worker& worker) const {
  const Pixel pixel{first.u + column, first.v + row};
  worker.patch.look_at(column);
  const float mean = worker.patch.mean();
  const float residual = 1.0F / cloud.depth()[index(pixel, cloud.camera())] - mean;
  const float own = worker.noise.own_variance(mean) + worker.patch.variance();
  const auto gate = static_cast<float>(options_.gate * options_.gate);
  if (residual * residual > gate * (own + worker.noise.shared_variance())) return;
  const std::span<float> values = worker.noise.add(column, row, own);
  worker.differentiate(pixel, cloud.camera(), values);
  values.back() = residual;
}

void EdgeTerm::sum_up(const Eigen::Isometry3d& T_camera_base) {
  const Index unknowns = information_.rows();
  sum_.setZero(unknowns + 1, unknowns + 1);
  pixels_ = 0.0;
  for (const Strip& strip : std::span(strips_.data(), strip_count_)) {
    sum_ += strip.products;
    pixels_ += strip.pixels;
  }
  chi_squared_ = 0.0;
  information_.setZero();
  gradient_.setZero();
  if (pixels_ == 0.0) return;
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
