// SPDX-License-Identifier: BSD-3-Clause
#include "contour_lines.hpp"

#include <algorithm>
#include <cmath>

#include "evidence_constants.hpp"

namespace lockbox {
namespace {

constexpr float kSameLine = 0.87F;       // cosine of 30 degrees: from where a line set out
constexpr float kSameDirection = 0.71F;  // of 45 degrees: of a model's line and the scene's
constexpr float kStraight = 0.95F;       // mean of unit vectors around a cell of a straight line
constexpr int kSmoothing = 2;            // cells around
constexpr int kGap = 2;                  // cells: with one between them in which nothing is known
constexpr int kLeastSights = 2;          // that do not go on: of a single one noise is enough

Eigen::Vector2f direction_at(const SceneCells& scene, std::span<const float> cells, int u, int v) {
  const auto here = static_cast<double>(cells[scene.index(u, v)]);
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  int ending = 0;
  for (const Sight& sight : kSights) {
    const int far_u = u + sight.far * sight.du;
    const int far_v = v + sight.far * sight.dv;
    if (!scene.contains(far_u, far_v)) continue;
    const auto near = static_cast<double>(
        cells[scene.index(u + sight.near * sight.du, v + sight.near * sight.dv)]);
    const auto far = static_cast<double>(cells[scene.index(far_u, far_v)]);
    const bool is_blank = !(near > 0.0 || far > 0.0);
    const bool is_known = near > 0.0 && far > 0.0;
    const bool ends = is_blank || (is_known && std::abs(sight.foretold(near, far) - here) >
                                                   evidence::kAgree * scene.deviation(here, sight));
    if (!ends) continue;
    ++ending;
    sum += Eigen::Vector2f(static_cast<float>(sight.du), static_cast<float>(sight.dv)).normalized();
  }
  constexpr float kLeastSum = 0.5F;  // less points nowhere: of a strip that ends on both sides
  return ending >= kLeastSights && sum.norm() > kLeastSum ? Eigen::Vector2f(sum.normalized())
                                                          : Eigen::Vector2f(0.0F, 0.0F);
}

}  // namespace

void ContourLines::find(const SceneCells& scene, std::span<const float> cells) {
  directions_.assign(cells.size(), Eigen::Vector2f::Zero());
  lines_.assign(cells.size(), -1);
  lengths_.clear();
  for (int v = 0; v < scene.height(); ++v) {
    for (int u = 0; u < scene.width(); ++u) {
      const std::size_t cell = scene.index(u, v);
      if (cells[cell] > 0.0F) directions_[cell] = direction_at(scene, cells, u, v);
    }
  }
  smooth(scene);
  // Where lines meet, directions are of neither.
  for (const float least : {kStraight, 0.0F}) {
    for (int v = 0; v < scene.height(); ++v) {
      for (int u = 0; u < scene.width(); ++u) {
        const std::size_t cell = scene.index(u, v);
        if (directions_[cell].norm() > least && lines_[cell] < 0) join(scene, u, v);
      }
    }
  }
}

/// Of cells at different distances from an edge other sights end: means with those around that face
/// about the same way. Their length tells whether they do.
void ContourLines::smooth(const SceneCells& scene) {
  raw_ = directions_;
  for (int v = 0; v < scene.height(); ++v) {
    for (int u = 0; u < scene.width(); ++u) {
      const std::size_t cell = scene.index(u, v);
      if (raw_[cell].isZero()) continue;
      Eigen::Vector2f sum = Eigen::Vector2f::Zero();
      int count = 0;
      for (int dv = -kSmoothing; dv <= kSmoothing; ++dv) {
        for (int du = -kSmoothing; du <= kSmoothing; ++du) {
          if (!scene.contains(u + du, v + dv)) continue;
          const Eigen::Vector2f& there = raw_[scene.index(u + du, v + dv)];
          if (there.dot(raw_[cell]) <= 0.0F) continue;
          sum += there;
          ++count;
        }
      }
      directions_[cell] = sum / static_cast<float>(count);
    }
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
        if (directions_[cell].isZero() || lines_[cell] >= 0) continue;
        if (directions_[cell].normalized().dot(direction) < kSameLine) continue;
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

}  // namespace lockbox
