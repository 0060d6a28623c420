// SPDX-License-Identifier: BSD-3-Clause
#include "cell_classification.hpp"

#include <algorithm>
#include <cmath>

#include "evidence_constants.hpp"

namespace lockbox {
namespace {

/// What the model shows within the tolerance of a contour around a cell, 1/metre.
struct Around {
  double farthest;
  double nearest;
  bool is_at_contour;  ///< it shows nothing in some of these cells

  /// How much nearer a measurement is than all of them; negative: farther; 0: among them.
  double beyond(double inverse_depth) const {
    if (inverse_depth > nearest) return inverse_depth - nearest;
    return std::min(0.0, inverse_depth - farthest);
  }
};

Around around(const SceneCells& scene, const ShownModel& model, int u, int v) {
  const double here = model.at(u, v);
  const int reach = scene.contour_reach(here);
  Around found{here, here, false};
  for (int dv = -reach; dv <= reach; ++dv) {
    for (int du = -reach; du <= reach; ++du) {
      if (du * du + dv * dv > reach * reach || !scene.contains(u + du, v + dv)) continue;
      const double there = model.at(u + du, v + dv);
      found.is_at_contour |= !(there > 0.0);
      if (there > 0.0) found.farthest = std::min(found.farthest, there);
      found.nearest = std::max(found.nearest, there);
    }
  }
  return found;
}

/// What lies on the scene's own surface errs, too.
double of_misfit(const SceneCells& scene, double misfit) {
  constexpr double kUsual = 2.0;  // standard deviations
  return -0.5 * std::max(0.0, misfit * misfit - kUsual * kUsual) / scene.options().face;
}

/// Adds what one cell says, unless it is hidden.
Seen classify_cell(const SceneCells& scene, const ShownModel& model, int u, int v, Evidence& sum) {
  const double cell = scene.at(u, v);
  const double here = model.at(u, v);
  const double deviation = scene.deviation(here);
  const double misfit = (cell - here) / deviation;
  if (std::abs(misfit) < scene.options().agree) {
    sum.misfit += of_misfit(scene, misfit);
    return Seen::explained;
  }
  const Around near = around(scene, model, u, v);
  const double beyond = near.beyond(cell);
  if (std::abs(beyond) < scene.options().agree * deviation) {
    sum.misfit += of_misfit(scene, beyond / deviation);
    return Seen::explained;
  }
  if (beyond > 0.0) return Seen::occluder;
  if (near.is_at_contour) return Seen::explained;  // what lies beside the model
  const double anywhere = scene.options().outliers / scene.options().inverse_range;
  sum.free_space_violation +=
      std::min(0.0, std::log(anywhere / scene.density(u, v))) / evidence::kWindow;
  return Seen::behind;
}

}  // namespace

Evidence CellClassification::classify(const SceneCells& scene, const ShownModel& model,
                                      std::size_t bodies, const Executor& executor) {
  seen_.assign(model.image.id.size(), Seen::nothing);
  rows_.assign(static_cast<std::size_t>(scene.height()), {});
  const ImageWindow& drawn = model.image.drawn;
  constexpr std::size_t kRows = 8;  // a chunk
  const auto rows = static_cast<std::size_t>(std::max(0, drawn.height));
  executor.for_each_chunk(rows, kRows, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      classify_row(scene, model, drawn.top + static_cast<int>(i));
    }
  });
  find_mute_bodies(model, bodies, scene.options().least_seen);
  Evidence all;
  for (const Evidence& row : rows_) all += row;
  return all;
}

void CellClassification::classify_row(const SceneCells& scene, const ShownModel& model, int v) {
  Evidence& sum = rows_[static_cast<std::size_t>(v)];
  for (int u = model.image.drawn.left; u < model.image.drawn.right(); ++u) {
    if (!(model.at(u, v) > 0.0) || !(scene.at(u, v) > 0.0)) continue;
    ++sum.cells;
    seen_[model.index(u, v)] = classify_cell(scene, model, u, v, sum);
  }
}

/// The base is what is sought, however little of it is seen.
void CellClassification::find_mute_bodies(const ShownModel& model, std::size_t bodies,
                                          double least_seen) {
  explained_cells_.assign(bodies, 0);
  hidden_cells_.assign(bodies, 0);
  const ImageWindow& drawn = model.image.drawn;
  for (int v = drawn.top; v < drawn.bottom(); ++v) {
    for (int u = drawn.left; u < drawn.right(); ++u) {
      const std::size_t cell = model.index(u, v);
      if (seen_[cell] == Seen::nothing) continue;
      const auto body = static_cast<std::size_t>(model.image.id[cell]);
      explained_cells_[body] += seen_[cell] == Seen::explained ? 1 : 0;
      hidden_cells_[body] += seen_[cell] == Seen::occluder ? 1 : 0;
    }
  }
  is_mute_.assign(bodies, 0);
  for (std::size_t b = 1; b < bodies; ++b) {
    const double all = explained_cells_[b] + hidden_cells_[b];
    is_mute_[b] = explained_cells_[b] < least_seen * all ? 1 : 0;
  }
}

}  // namespace lockbox
