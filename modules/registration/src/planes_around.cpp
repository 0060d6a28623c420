// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/planes_around.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

namespace lockbox {
namespace {

constexpr std::size_t kMostSamples = 800;  // of the model and around it: more say the same
constexpr std::size_t kLeastSamples = 40;  // fewer, at the image's rim, tell no plane
constexpr double kLeastShare = 0.2;        // of these, on a plane that goes on around the model
constexpr int kMostPlanes = 3;             // a table, a wall, the floor
constexpr int kDraws = 80;  // of three; a plane of a third of them is found 95 in 100 times
constexpr int kFits = 2;

/// Of the view, pixels.
struct Window {
  int left;
  int top;
  int right;
  int bottom;
};

/// Where the view shows the model.
std::optional<Window> shown(const RenderedDepth& view) {
  Window window{view.width, view.height, -1, -1};
  for (int v = view.drawn.top; v < view.drawn.bottom(); ++v) {
    for (int u = view.drawn.left; u < view.drawn.right(); ++u) {
      if (view.id[view.index(u, v)] == kNothing) continue;
      window.left = std::min(window.left, u);
      window.right = std::max(window.right, u + 1);
      window.top = std::min(window.top, v);
      window.bottom = std::max(window.bottom, v + 1);
    }
  }
  if (window.right < 0) return std::nullopt;
  return window;
}

/// With surroundings half as wide as the model to each side.
Window widened(const Window& window, const RenderedDepth& view) {
  const int across = (window.right - window.left) / 2;
  const int up = (window.bottom - window.top) / 2;
  return {std::max(0, window.left - across), std::max(0, window.top - up),
          std::min(view.width, window.right + across), std::min(view.height, window.bottom + up)};
}

/// So that a grid over the window has no more nodes.
int spacing(const Window& window, std::size_t most) {
  const double area = static_cast<double>(window.right - window.left) *
                      static_cast<double>(window.bottom - window.top);
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(area / static_cast<double>(most)))));
}

}  // namespace

std::optional<double> PlanesAround::evidence(const VisibleSurface& surface, const TiledCloud& cloud,
                                             const RegistrationOptions& options) {
  collect(surface, cloud);
  if (around_.size() < kLeastSamples || model_.empty()) return std::nullopt;
  const double gate = options.cut * options.noise.sigma_inverse_depth();
  find_planes(gate);
  if (planes_.empty()) return std::nullopt;
  double sum = 0.0;
  for (const auto& [measured, expected] : model_) {
    double beside = gate;
    for (const Plane& plane : planes_) {
      beside = std::min(beside, std::abs(measured.nearness - plane.dot(measured.place)));
    }
    const double off = std::min(gate, std::abs(measured.nearness - expected));
    sum += (beside * beside - off * off) / (gate * gate);
  }
  return sum / static_cast<double>(model_.size());
}

void PlanesAround::collect(const VisibleSurface& surface, const TiledCloud& cloud) {
  around_.clear();
  model_.clear();
  around_.reserve(2 * kMostSamples);  // frames allocate nothing
  model_.reserve(2 * kMostSamples);
  planes_.reserve(kMostPlanes);
  const RenderedDepth& view = surface.view();
  const auto model = shown(view);
  if (!model) return;
  const Window window = widened(*model, view);
  const int step = spacing(window, kMostSamples);
  for (int v = window.top; v < window.bottom; v += step) {
    for (int u = window.left; u < window.right; u += step) {
      const Pixel seen = surface.camera_pixel(u, v);
      const auto depth =
          static_cast<double>(cloud.depth()[static_cast<std::size_t>(seen.v) *
                                                static_cast<std::size_t>(cloud.camera().width) +
                                            static_cast<std::size_t>(seen.u)]);
      if (depth <= 0.0) continue;
      const Sample sample{{static_cast<double>(u), static_cast<double>(v), 1.0}, 1.0 / depth};
      const std::size_t pixel = view.index(u, v);
      if (view.id[pixel] == kNothing) {
        around_.push_back(sample);
      } else {
        model_.push_back({sample, 1.0 / static_cast<double>(view.depth[pixel])});
      }
    }
  }
}

/// One after the other, each from the samples that those before it leave.
void PlanesAround::find_planes(double gate) {
  planes_.clear();
  const double least = kLeastShare * static_cast<double>(around_.size());
  for (int i = 0; i < kMostPlanes; ++i) {
    const auto plane = largest_plane(gate);
    if (!plane) return;
    const auto end = std::remove_if(around_.begin(), around_.end(), [&](const Sample& sample) {
      return std::abs(sample.nearness - plane->dot(sample.place)) < gate;
    });
    if (static_cast<double>(around_.end() - end) < least) return;
    around_.erase(end, around_.end());
    if (is_cut(*plane, gate)) planes_.push_back(*plane);
  }
}

/// Through three samples drawn by lot, and then through all that are near it.
std::optional<PlanesAround::Plane> PlanesAround::largest_plane(double gate) const {
  if (around_.size() < kLeastSamples) return std::nullopt;
  std::minstd_rand lot;  // the same in each frame
  const auto drawn = [&]() -> const Sample& { return around_[lot() % around_.size()]; };
  std::optional<Plane> best;
  std::ptrdiff_t most = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::Matrix3d places;
    Eigen::Vector3d nearness;
    for (Eigen::Index row = 0; row < 3; ++row) {
      const Sample& sample = drawn();
      places.row(row) = sample.place.transpose();
      nearness[row] = sample.nearness;
    }
    if (std::abs(places.determinant()) < 1.0) continue;  // in a line
    const Plane plane = places.inverse() * nearness;
    const auto count = std::count_if(around_.begin(), around_.end(), [&](const Sample& sample) {
      return std::abs(sample.nearness - plane.dot(sample.place)) < gate;
    });
    if (count <= most) continue;
    most = count;
    best = plane;
  }
  if (!best) return std::nullopt;
  return fitted(*best, gate);
}

PlanesAround::Plane PlanesAround::fitted(const Plane& start, double gate) const {
  Plane plane = start;
  for (int i = 0; i < kFits; ++i) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Sample& sample : around_) {
      if (std::abs(sample.nearness - plane.dot(sample.place)) >= gate) continue;
      information += sample.place * sample.place.transpose();
      sum += sample.nearness * sample.place;
    }
    plane = information.ldlt().solve(sum);
  }
  return plane;
}

/// Whether most of what is measured on the model lies in the plane or before it. Else the plane
/// stands before the model, as a screen does, and would go on whether the model is there or not.
bool PlanesAround::is_cut(const Plane& plane, double gate) const {
  std::ptrdiff_t before = 0;
  std::ptrdiff_t behind = 0;
  for (const auto& [measured, expected] : model_) {
    if (std::abs(measured.nearness - expected) >= gate) continue;
    (measured.nearness > plane.dot(measured.place) - gate ? before : behind) += 1;
  }
  return before >= behind;
}

}  // namespace lockbox
