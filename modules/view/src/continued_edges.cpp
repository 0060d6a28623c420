// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/continued_edges.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/view/contour.hpp"

namespace lockbox {
namespace {

constexpr int kStretchCell = 8;  // pixels of the view along each side of what makes a stretch
constexpr std::size_t kRowsTogether = 8;  // of the view, that a thread takes at once
constexpr int kWays = 4;                  // to the sides of a pixel
/// (du, dv) of each.
constexpr std::array<std::array<int, 2>, kWays> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
/// Metres beyond an edge that are looked at: as far as the widest gate of tracking reaches, four
/// standard deviations of 5 mm. Twice as far, neighbours narrower than that are taken for none.
constexpr double kLeastReach = 0.02;
/// Standard deviations of a depth, of means over a stretch, which err by a third of one: nearer to
/// the plane than four of these, the scene goes on in it; and the model must differ from it by
/// twice that to be contradicted. Doubled, a board that stands so far before a wall is flush with
/// it.
constexpr double kGoesOn = 1.25;
constexpr double kDiffers = 2.0 * kGoesOn;
/// The share of a surface's pixels that noise leaves within the gate: all but a tenth of outliers.
constexpr double kLeastNear = 0.9;
/// Standard deviations of what is level: a seam between bodies.
constexpr double kLevel = 0.1;
/// Tri-linear distances turn normals within so many voxels of an edge.
constexpr double kRoundedVoxels = 2.0;
/// The share of its contour that goes on beyond a body which is flush with something: one side of
/// four. Beyond the edge of one that has moved on, its own surface goes on.
constexpr double kLeastFlush = 0.25;
constexpr int kLeastLength = 3;  // pixels of the view: less has no farther half

bool contains(const RenderedDepth& view, int u, int v) {
  return u >= 0 && v >= 0 && u < view.width && v < view.height;
}

/// Whether a surface comes to the pixel in its tangent plane, to so many metres: the pixel lies
/// before a bend, not in it.
bool comes_level(const RenderedDepth& view, const TangentPlane& plane, const Pixel& pixel, int way,
                 double level) {
  const auto& [du, dv] = kSteps[static_cast<std::size_t>(way)];
  const std::size_t here = view.index(pixel.u, pixel.v);
  for (const int k : {-1, -2}) {
    if (!contains(view, pixel.u + k * du, pixel.v + k * dv)) return false;
    const std::size_t before = view.index(pixel.u + k * du, pixel.v + k * dv);
    const double expected =
        static_cast<double>(view.depth[here]) * plane.relative_depth(k * du, k * dv);
    if (view.id[before] != view.id[here] ||
        !(std::abs(static_cast<double>(view.depth[before]) - expected) < level)) {
      return false;
    }
  }
  return true;
}

/// How far behind the plane something lies, in the mean over a walk, and over its farther half.
/// What lies on both sides of the plane is not one surface that goes on in it, whatever its mean.
class Behind {
 public:
  explicit Behind(double gate) : gate_(gate) {}

  void add(double behind, bool is_far) {
    sum_ += behind;
    ++count_;
    near_ += std::abs(behind) < gate_ ? 1 : 0;
    far_sum_ += is_far ? behind : 0.0;
    far_count_ += is_far ? 1 : 0;
  }
  bool knows(int length) const { return 2 * count_ >= length && 4 * far_count_ >= length; }
  double mean() const { return is_one_surface() ? sum_ / count_ : gate_; }
  double far_mean() const { return is_one_surface() ? far_sum_ / far_count_ : gate_; }

 private:
  bool is_one_surface() const { return near_ >= kLeastNear * count_; }

  double gate_;
  double sum_ = 0.0;
  double far_sum_ = 0.0;
  int count_ = 0;
  int near_ = 0;
  int far_count_ = 0;
};

}  // namespace

ContinuedEdges::Stretch& ContinuedEdges::Stretch::operator+=(const Stretch& other) {
  measured += other.measured;
  measured_far += other.measured_far;
  predicted += other.predicted;
  walks += other.walks;
  return *this;
}

void ContinuedEdges::find(const ArticulatedModel& model, const VisibleSurface& surface,
                          const ViewEdges& edges, const TiledCloud& cloud, double reach,
                          const ViewOptions& options, const Executor& executor) {
  const RenderedDepth& view = surface.view();
  options_ = options;
  reach_ = std::max(reach, kLeastReach);
  rounded_.clear();
  for (const auto& field : model.fields) {
    rounded_.push_back(field ? kRoundedVoxels * field->voxel() : 0.0);
  }
  columns_ = view.width / kStretchCell + 1;
  rows_ = view.height / kStretchCell + 1;
  view_rows_.resize(static_cast<std::size_t>(view.height));
  executor.for_each_chunk(view_rows_.size(), kRowsTogether,
                          [&](std::size_t begin, std::size_t end, auto) {
                            for (std::size_t v = begin; v < end; ++v) {
                              look_along(surface, edges, cloud, static_cast<int>(v));
                            }
                          });
  add_up();
  is_any_ = false;
  is_flush_.assign(model.fields.size(), false);
  find_flush_bodies(view);
  for (const Row& row : view_rows_) {
    for (const Walk& walk : row.walks) {
      if (walk.goes_on && is_of_flush_body(walk, view)) cover(walk, view);
    }
    // What pulls at one body at a seam pulls at its neighbour the other way: it matters only where
    // nothing else says where the two of them are.
    for (const Walk& seam : row.seams) {
      if (is_of_flush_body(seam, view)) cover(seam, view);
    }
  }
}

/// Adds up in the order of the rows, whichever thread looked along them.
void ContinuedEdges::add_up() {
  stretches_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) * kWays,
                    Stretch{});
  for (const Row& row : view_rows_) {
    for (const Walk& walk : row.walks) stretches_[walk.stretch] += walk.found;
  }
}

void ContinuedEdges::look_along(const VisibleSurface& surface, const ViewEdges& edges,
                                const TiledCloud& cloud, int v) {
  const RenderedDepth& view = surface.view();
  Row& row = view_rows_[static_cast<std::size_t>(v)];
  row.walks.clear();
  row.seams.clear();
  for (const int u : edges.row(v)) {
    if (view.id[view.index(u, v)] == kNothing) continue;
    const TangentPlane plane(view, u, v);
    for (int way = 0; way < kWays; ++way) look_across(surface, cloud, plane, {u, v}, way);
  }
}

/// Where little of a body's contour goes on, the body may have moved on from where it was
/// predicted, and what goes on is its own surface, which it must follow.
void ContinuedEdges::find_flush_bodies(const RenderedDepth& view) {
  going_on_.assign(is_flush_.size(), 0);
  looked_at_.assign(is_flush_.size(), 0);
  for (Row& row : view_rows_) {
    for (Walk& walk : row.walks) {
      const auto body = static_cast<std::size_t>(view.id[view.index(walk.u, walk.v)]);
      const Stretch stretch = around(walk.stretch);
      ++looked_at_[body];
      going_on_[body] += lies_within(stretch, kGoesOn * stretch.walks) ? 1 : 0;
      walk.goes_on = lies_within(stretch, 0.5 * stretch.predicted);
    }
  }
  for (std::size_t body = 0; body < is_flush_.size(); ++body) {
    is_flush_[body] = going_on_[body] > 0 && going_on_[body] >= kLeastFlush * looked_at_[body];
  }
}

bool ContinuedEdges::is_of_flush_body(const Walk& walk, const RenderedDepth& view) const {
  return is_flush_[static_cast<std::size_t>(view.id[view.index(walk.u, walk.v)])];
}

/// Looks from a pixel to its neighbour, which may fall back behind its plane, or go on in it as
/// another body.
void ContinuedEdges::look_across(const VisibleSurface& surface, const TiledCloud& cloud,
                                 const TangentPlane& plane, const Pixel& pixel, int way) {
  const RenderedDepth& view = surface.view();
  const auto& [du, dv] = kSteps[static_cast<std::size_t>(way)];
  const auto& [u, v] = pixel;
  if (!contains(view, u + du, v + dv)) return;
  const std::size_t here = view.index(u, v);
  const std::size_t next = view.index(u + du, v + dv);
  const auto depth = static_cast<double>(view.depth[here]);
  const double least = kLevel * options_.noise.sigma_z(depth);
  const double behind =
      static_cast<double>(view.depth[next]) - depth * plane.relative_depth(du, dv);
  const bool falls_back = behind > least;
  const bool is_seam = !falls_back && view.id[here] != view.id[next] && behind > -least;
  if (!(falls_back || is_seam) || !comes_level(view, plane, pixel, way, least)) return;
  const double size = depth / surface.view_camera().fx;
  const auto pixels = [size](double metres) { return static_cast<int>(std::ceil(metres / size)); };
  const double rounded = rounded_[static_cast<std::size_t>(view.id[here])];
  Row& row = view_rows_[static_cast<std::size_t>(v)];
  if (is_seam) {
    row.seams.push_back({u, v, way, 0, pixels(rounded), 0});
    return;
  }
  const auto stretch =
      static_cast<std::size_t>(kWays * (v / kStretchCell * columns_ + u / kStretchCell) + way);
  // Noise along the ray takes points of the face so far behind it that its side is nearer.
  const double noisy = options_.gate * options_.noise.sigma_z(depth);
  Walk beyond{u, v, way, pixels(reach_) + 1, pixels(std::max(rounded, noisy)), stretch};
  if (walk(surface, cloud, plane, beyond)) row.walks.push_back(beyond);
}

/// What lies before another body of the model is known to end there: a slider that has moved on
/// from where it was predicted goes on beyond its edge, and must be followed. Returns whether the
/// walk tells anything.
bool ContinuedEdges::walk(const VisibleSurface& surface, const TiledCloud& cloud,
                          const TangentPlane& plane, Walk& walk) const {
  const RenderedDepth& view = surface.view();
  const auto& [du, dv] = kSteps[static_cast<std::size_t>(walk.way)];
  if (walk.length < kLeastLength ||
      !contains(view, walk.u + walk.length * du, walk.v + walk.length * dv)) {
    return false;
  }
  const auto depth = static_cast<double>(view.depth[view.index(walk.u, walk.v)]);
  const std::int16_t body = view.id[view.index(walk.u, walk.v)];
  const double noise = options_.noise.sigma_z(depth);
  const auto behind = [&](double z, double goes_on) {
    return std::clamp((z - goes_on) / noise, -options_.gate, options_.gate);
  };
  const auto measured_at = [&](int u, int v) {
    const Pixel seen = surface.camera_pixel(u, v);
    const auto width = static_cast<std::size_t>(cloud.camera().width);
    return static_cast<double>(
        cloud.depth()[static_cast<std::size_t>(seen.v) * width + static_cast<std::size_t>(seen.u)]);
  };
  // An edge that something else hides tells nothing.
  const double here = measured_at(walk.u, walk.v);
  if (here > 0.0 && !(std::abs(behind(here, depth)) < options_.gate)) return false;
  Behind measured(options_.gate);
  double predicted = 0.0;
  for (int k = 1; k <= walk.length; ++k) {
    const int u = walk.u + k * du;
    const int v = walk.v + k * dv;
    const std::int16_t shown = view.id[view.index(u, v)];
    if (shown != body && shown != kNothing) return false;
    const double goes_on = depth * plane.relative_depth(k * du, k * dv);
    predicted += behind(static_cast<double>(view.depth[view.index(u, v)]), goes_on);
    const double z = measured_at(u, v);
    if (z > 0.0) measured.add(behind(z, goes_on), 2 * k > walk.length);
  }
  if (!measured.knows(walk.length)) return false;
  walk.found = {measured.mean(), measured.far_mean(), predicted / walk.length, 1};
  return true;
}

/// Whether the scene lies so near to the plane, while the model is clearly behind it.
bool ContinuedEdges::lies_within(const Stretch& stretch, double limit) {
  return std::abs(stretch.measured) < limit && std::abs(stretch.measured_far) < limit &&
         stretch.predicted > kDiffers * stretch.walks;
}

/// Returns the stretch with its neighbours: the noise of one goes together.
ContinuedEdges::Stretch ContinuedEdges::around(std::size_t stretch) const {
  const int way = static_cast<int>(stretch) % kWays;
  const int cell = static_cast<int>(stretch) / kWays;
  Stretch sum;
  for (int row = cell / columns_ - 1; row <= cell / columns_ + 1; ++row) {
    for (int column = cell % columns_ - 1; column <= cell % columns_ + 1; ++column) {
      if (row < 0 || column < 0 || row >= rows_ || column >= columns_) continue;
      sum += stretches_[static_cast<std::size_t>(kWays * (row * columns_ + column) + way)];
    }
  }
  return sum;
}

/// What lies before and beyond the edge, and to both sides as far as beyond: past a corner, too.
void ContinuedEdges::cover(const Walk& walk, const RenderedDepth& view) {
  if (!is_any_) covered_.assign(view.id.size(), 0);
  is_any_ = true;
  const auto& [du, dv] = kSteps[static_cast<std::size_t>(walk.way)];
  for (int k = -walk.within; k <= walk.length; ++k) {
    for (int aside = std::min(0, -k); aside <= std::max(0, k); ++aside) {
      const int u = walk.u + k * du + aside * dv;
      const int v = walk.v + k * dv + aside * du;
      if (contains(view, u, v)) covered_[view.index(u, v)] = 1;
    }
  }
}

}  // namespace lockbox
