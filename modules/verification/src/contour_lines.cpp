// SPDX-License-Identifier: BSD-3-Clause
#include "contour_lines.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

constexpr float kSameLine = 0.87F;       // cosine of 30 degrees: from where a line set out
constexpr float kSameDirection = 0.71F;  // of 45 degrees: of a model's line and the scene's
constexpr float kStraight = 0.95F;       // mean of unit vectors around a cell of a straight line
constexpr int kSmoothing = 2;            // cells around
constexpr int kGap = 2;                  // cells: with one between them in which nothing is known
constexpr float kLeastSights = 2.0F;     // that do not go on: of a single one noise is enough
/// Two of eight sights, which err by themselves, are beyond so many of EvidenceOptions::agree in no
/// more cells than a single one is beyond one of it: 28 p^2 = 1 / 370. What a model is off by, all
/// sights see.
constexpr double kOfTwoSights = 0.86;
constexpr float kLeastOfStrip = 4.0F;  // likewise, two to each side

float square(double value) {
  return static_cast<float>(value * value);
}

/// So many standard deviations of a cell's noise, as loops over rows want it.
struct NoisePolynomial {
  NoisePolynomial(const SceneCells& scene, double deviations)
      : constant(static_cast<float>(deviations * scene.share() * scene.sensor().depth_quadratic)),
        linear(static_cast<float>(deviations * scene.share() * scene.sensor().depth_linear)),
        quadratic(static_cast<float>(deviations * scene.share() * scene.sensor().depth_floor)) {}

  float at(float inverse_depth) const {
    return constant + inverse_depth * (linear + inverse_depth * quadratic);
  }

  float constant;
  float linear;
  float quadratic;
};

/// Adds the sights of a row's cells that end, in one direction. No branches: the loop runs over
/// every cell of an image.
void add_ends(const SceneCells& scene, std::span<const float> cells, double share, int v,
              const Sight& sight, ContourLines::Ends& ends) {
  const int near_v = v + sight.near * sight.dv;
  const int far_v = v + sight.far * sight.dv;
  if (far_v < 0 || far_v >= scene.height()) return;
  const int reach = sight.far * sight.du;
  const int first = std::max(0, -reach);
  const int last = std::min(scene.width(), scene.width() - reach);
  const float* const here = cells.data() + scene.index(0, v);
  const float* const near = cells.data() + scene.index(0, near_v) + sight.near * sight.du;
  const float* const far = cells.data() + scene.index(0, far_v) + reach;
  const auto ratio = static_cast<float>(sight.ratio());
  const double of_sight =
      share * kOfTwoSights * scene.options().agree * std::sqrt(1.0 + sight.variances());
  const NoisePolynomial noise(scene, of_sight);
  const float of_tolerance = square(share * scene.options().agree * scene.tolerance());
  const Eigen::Vector2f way = sight.way();
  float* const count = ends.count.data();
  float* const sum_u = ends.u.data();
  float* const sum_v = ends.v.data();
  for (int u = first; u < last; ++u) {
    const float squared = here[u] * here[u];
    const float off = near[u] + ratio * (near[u] - far[u]) - here[u];
    const float of_noise = noise.at(here[u]);
    const bool deviates = off * off > of_noise * of_noise + of_tolerance * squared * squared;
    const bool is_near = near[u] > 0.0F;
    const bool is_far = far[u] > 0.0F;
    const bool ends_here = (deviates && is_near && is_far) || (!is_near && !is_far);
    const float one = ends_here ? 1.0F : 0.0F;
    count[u] += one;
    sum_u[u] += one * way.x();
    sum_v[u] += one * way.y();
  }
}

}  // namespace

void ContourLines::find(const SceneCells& scene, std::span<const float> cells, double share,
                        const Executor& executor) {
  raw_.resize(cells.size());
  strips_.resize(cells.size());
  directions_.resize(cells.size());
  ends_.resize(static_cast<std::size_t>(executor.threads()));
  const auto rows = static_cast<std::size_t>(scene.height());
  constexpr std::size_t kRows = 8;  // a chunk
  executor.for_each_chunk(rows, kRows, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t v = begin; v < end; ++v) find_in_row(scene, cells, share, static_cast<int>(v));
  });
  executor.for_each_chunk(rows, kRows, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t v = begin; v < end; ++v) smooth_row(scene, static_cast<int>(v));
  });
}

void ContourLines::join_lines(const SceneCells& scene) {
  lines_.assign(directions_.size(), -1);
  lengths_.clear();
  // Where lines meet, directions are of neither.
  for (const float least : {kStraight, 0.0F}) {
    for (int v = 0; v < scene.height(); ++v) {
      for (int u = 0; u < scene.width(); ++u) {
        const std::size_t cell = scene.index(u, v);
        if (directions_[cell].squaredNorm() > least * least && lines_[cell] < 0) join(scene, u, v);
      }
    }
  }
}

void ContourLines::find_in_row(const SceneCells& scene, std::span<const float> cells, double share,
                               int v) {
  Ends& ends = ends_[Executor::worker()];
  for (auto* sums : {&ends.count, &ends.u, &ends.v}) {
    sums->assign(static_cast<std::size_t>(scene.width()), 0.0F);
  }
  for (const Sight& sight : kSights) add_ends(scene, cells, share, v, sight, ends);
  constexpr float kLeastSum = 0.5F;  // less points nowhere: of a strip that ends on both sides
  for (int u = 0; u < scene.width(); ++u) {
    const auto column = static_cast<std::size_t>(u);
    const Eigen::Vector2f sum(ends.u[column], ends.v[column]);
    const std::size_t cell = scene.index(u, v);
    const bool is_known = cells[cell] > 0.0F;
    const bool points = sum.squaredNorm() > kLeastSum * kLeastSum;
    const bool is_contour = is_known && points && ends.count[column] >= kLeastSights;
    raw_[cell] = is_contour ? Eigen::Vector2f(sum.normalized()) : Eigen::Vector2f(0.0F, 0.0F);
    strips_[cell] = is_known && !points && ends.count[column] >= kLeastOfStrip ? 1 : 0;
  }
}

/// Smooths a row. Of cells at different distances from an edge other sights end: means with those
/// around that face about the same way. Their length tells whether they do.
void ContourLines::smooth_row(const SceneCells& scene, int v) {
  for (int u = 0; u < scene.width(); ++u) {
    const std::size_t cell = scene.index(u, v);
    directions_[cell].setZero();
    if (raw_[cell].isZero()) continue;
    Eigen::Vector2f sum = Eigen::Vector2f::Zero();
    int count = 0;
    for (int at_v = std::max(0, v - kSmoothing); at_v <= v + kSmoothing; ++at_v) {
      for (int at_u = std::max(0, u - kSmoothing); at_u <= u + kSmoothing; ++at_u) {
        if (!scene.contains(at_u, at_v)) continue;
        const Eigen::Vector2f& there = raw_[scene.index(at_u, at_v)];
        if (there.dot(raw_[cell]) <= 0.0F) continue;
        sum += there;
        ++count;
      }
    }
    directions_[cell] = sum / static_cast<float>(count);
  }
}

/// All that is connected with a cell and faces the same way.
void ContourLines::join(const SceneCells& scene, int u, int v) {
  const std::size_t seed = scene.index(u, v);
  const Eigen::Vector2f direction = directions_[seed].normalized();
  const auto line = static_cast<std::int32_t>(lengths_.size());
  lengths_.push_back(1);
  lines_[seed] = line;
  open_.assign(1, {u, v});
  while (!open_.empty()) {
    const auto [at_u, at_v] = open_.back();
    open_.pop_back();
    for (int dv = -kGap; dv <= kGap; ++dv) {
      for (int du = -kGap; du <= kGap; ++du) {
        if (!scene.contains(at_u + du, at_v + dv)) continue;
        const std::size_t cell = scene.index(at_u + du, at_v + dv);
        const Eigen::Vector2f& there = directions_[cell];
        if (lines_[cell] >= 0 || there.isZero()) continue;
        if (there.dot(direction) < kSameLine * there.norm()) continue;
        lines_[cell] = line;
        ++lengths_.back();
        open_.emplace_back(at_u + du, at_v + dv);
      }
    }
  }
}

bool ContourLines::passes(const SceneCells& scene, int u, int v, int reach,
                          const Eigen::Vector2f& direction) const {
  for (int dv = -reach; dv <= reach; ++dv) {
    for (int du = -reach; du <= reach; ++du) {
      if (!scene.contains(u + du, v + dv)) continue;
      const Eigen::Vector2f& there = directions_[scene.index(u + du, v + dv)];
      if (there.dot(direction) > kSameDirection * there.norm() * direction.norm()) return true;
    }
  }
  return false;
}

bool ContourLines::has_strip(const SceneCells& scene, int u, int v, int reach) const {
  for (int at_v = std::max(0, v - reach); at_v <= std::min(scene.height() - 1, v + reach); ++at_v) {
    for (int at_u = std::max(0, u - reach); at_u <= std::min(scene.width() - 1, u + reach);
         ++at_u) {
      if (strips_[scene.index(at_u, at_v)] != 0) return true;
    }
  }
  return false;
}

}  // namespace lockbox
