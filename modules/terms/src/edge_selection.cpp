// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/edge_selection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <span>

#include "lockbox/kernels/contours.hpp"

namespace lockbox {
namespace {

/// Pixels that an edge may lie beside a pixel of the view that shows it: the view was drawn a
/// little elsewhere.
constexpr int kAside = 1;

int patches_along(int pixels) {
  return (pixels + EdgeSelection::kSide - 1) / EdgeSelection::kSide;
}

/// How the inverse depth changes around a pixel of a view, 1/metre and pixel of it.
struct DepthStep {
  DepthStep(const RenderedDepth& view, const Pixel& pixel) {
    const float* const z = view.depth.data() + view.index(pixel.u, pixel.v);
    const float here = 1.0F / *z;
    const float left = 1.0F / *(z - 1);
    const float right = 1.0F / *(z + 1);
    const float above = 1.0F / *(z - view.width);
    const float below = 1.0F / *(z + view.width);
    gradient = 0.5F * Eigen::Vector2f(right - left, below - above);
    const float mean = 0.25F * (left + right + above + below);
    is_nearer = mean < here;
  }

  Eigen::Vector2f gradient;
  bool is_nearer;  ///< than what is around it: the edge is its own
};

/// How a point's image moves with a twist (v, w) of its body in the camera's frame, but for the
/// focal length.
Eigen::Vector2f flow(const Eigen::Vector3f& p, const BodyJacobian& screws, int column) {
  const Eigen::Matrix<float, 6, 1> twist = screws.col(column).cast<float>();
  const Eigen::Vector3f velocity = twist.head<3>() + twist.tail<3>().cross(p);
  return (velocity.head<2>() - velocity.z() / p.z() * p.head<2>()) / p.z();
}

}  // namespace

void EdgeSelection::select(const VisibleSurface& surface, const PinholeCamera& camera,
                           float least_bend, const Executor& executor) {
  columns_ = patches_along(camera.width);
  rows_.resize(static_cast<std::size_t>(patches_along(camera.height)));
  executor.for_each(rows_.size(), [&](std::size_t number) {
    Row& row = rows_[number];
    row.shows_edge.assign(static_cast<std::size_t>(columns_), 0);
    row.edges.clear();
    row.columns.clear();
    find_edges(surface, least_bend, static_cast<int>(number), row);
    for (int column = 0; column < columns_; ++column) {
      if (row.shows_edge[static_cast<std::size_t>(column)] != 0) row.columns.push_back(column);
    }
  });
}

void EdgeSelection::find_edges(const VisibleSurface& surface, float least_bend, int number,
                               Row& row) const {
  const RenderedDepth& view = surface.view();
  const int first = std::max(view.drawn.left, 1);
  const int end = std::min(view.drawn.right(), view.width - 1);
  if (first >= end) return;
  row.bends.resize(static_cast<std::size_t>(view.width) + kernels::kLanes);
  const int top = kSide * number;
  const int bottom = top + kSide;
  const int first_v = std::max({view.drawn.top, 1, (top - kAside) / surface.reduction() - 1});
  const int end_v = std::min(view.drawn.bottom(), view.height - 1);
  for (int v = first_v; v < end_v; ++v) {
    const int camera_v = surface.camera_pixel(0, v).v;
    if (camera_v < top - kAside) continue;
    if (camera_v >= bottom + kAside) break;
    const float* const z = view.depth.data() + view.index(0, v);
    const std::size_t count =
        kernels::find_bends({z - view.width, z, z + view.width}, static_cast<std::size_t>(first),
                            static_cast<std::size_t>(end), least_bend, row.bends.data());
    for (const int u : std::span(row.bends.data(), count)) {
      mark(surface.camera_pixel(u, v).u, row);
      if (camera_v >= top && camera_v < bottom) row.edges.push_back({u, v});
    }
  }
}

/// The patches around a column of pixels.
void EdgeSelection::mark(int camera_column, Row& row) const {
  const int first = std::max(camera_column - kAside, 0) / kSide;
  const int last = std::min((camera_column + kAside) / kSide, columns_ - 1);
  for (int column = first; column <= last; ++column) {
    row.shows_edge[static_cast<std::size_t>(column)] = 1;
  }
}

void EdgeSelection::keep_best(const VisibleSurface& surface,
                              const std::vector<BodyJacobian>& screws,
                              const std::vector<std::vector<int>>& variables, float variance,
                              std::size_t of_each_variable, const Executor& executor) {
  variables_ = static_cast<std::size_t>(screws.front().cols()) - 6;
  executor.for_each(rows_.size(), [&](std::size_t number) {
    Row& row = rows_[number];
    score(surface, screws, variables, variance, row);
    row.columns.swap(row.candidates);
    row.columns.clear();
  });
  for (std::size_t v = 0; v < variables_; ++v) find_best(v, of_each_variable);
  for (Row& row : rows_) {
    std::sort(row.columns.begin(), row.columns.end());
    row.columns.erase(std::unique(row.columns.begin(), row.columns.end()), row.columns.end());
  }
}

/// What a pixel at an edge measures changes with the image's motion across the edge by the
/// gradient, and errs by it, too: the pixel shows the one side or the other.
void EdgeSelection::score(const VisibleSurface& surface, const std::vector<BodyJacobian>& screws,
                          const std::vector<std::vector<int>>& variables, float variance,
                          Row& row) const {
  const RenderedDepth& view = surface.view();
  row.scores.assign(static_cast<std::size_t>(columns_) * variables_, 0.0F);
  for (const Pixel& pixel : row.edges) {
    const std::size_t i = view.index(pixel.u, pixel.v);
    const auto body = static_cast<std::size_t>(view.id[i]);
    const DepthStep step(view, pixel);
    if (variables[body].empty() || !step.is_nearer) continue;
    const auto depth = static_cast<double>(view.depth[i]);
    const Eigen::Vector3f p =
        surface.view_camera().back_project(pixel.u, pixel.v, depth).cast<float>();
    const auto column = static_cast<std::size_t>(surface.camera_pixel(pixel.u, pixel.v).u / kSide);
    for (const int v : variables[body]) {
      const float change = step.gradient.dot(flow(p, screws[body], unknown_of(v)));
      row.scores[column * variables_ + static_cast<std::size_t>(v)] +=
          change * change / (step.gradient.squaredNorm() + variance);
    }
  }
}

/// Adds patches to the rows' columns.
void EdgeSelection::find_best(std::size_t variable, std::size_t most) {
  scores_.clear();
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (const int c : rows_[r].candidates) {
      const float score = rows_[r].scores[static_cast<std::size_t>(c) * variables_ + variable];
      if (score > 0.0F) scores_.push_back({score, static_cast<int>(r), c});
    }
  }
  const auto end = scores_.begin() + static_cast<std::ptrdiff_t>(std::min(most, scores_.size()));
  std::nth_element(scores_.begin(), end, scores_.end(), [](const Score& a, const Score& b) {
    if (a.score != b.score) return a.score > b.score;
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
  std::for_each(scores_.begin(), end, [this](const Score& best) {
    rows_[static_cast<std::size_t>(best.row)].columns.push_back(best.column);
  });
}

}  // namespace lockbox
