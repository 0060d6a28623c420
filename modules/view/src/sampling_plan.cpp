// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/sampling_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lockbox {
namespace {

constexpr int kCell = SamplingDensity::kCellSize;

/// From one sample to the next, pixels of the view: in cells with edges, and in others.
struct Spacing {
  std::uint8_t edges;
  std::uint8_t others;
  std::size_t samples(std::size_t cells_with_edges, std::size_t other_cells) const {
    return cells_with_edges * in_a_cell(edges) + other_cells * in_a_cell(others);
  }
  static std::size_t in_a_cell(std::uint8_t spacing) {
    const auto along = static_cast<std::size_t>(kCell / spacing);
    return along * along;
  }
};
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr std::uint8_t kCoarsest = kCell;
/// What more samples are spent on, in order.
constexpr std::array<Spacing, 7> kSpacings{
    {{8, kCoarsest}, {4, kCoarsest}, {4, 4}, {2, 4}, {2, 2}, {1, 2}, {1, 1}}};

/// The body in the pixel, or next to it where the pixel shows nothing.
std::int16_t body_at(const RenderedDepth& view, int u, int v) {
  return std::max({view.id[view.index(u, v)], view.id[view.index(u - 1, v)],
                   view.id[view.index(u + 1, v)], view.id[view.index(u, std::max(v - 1, 0))],
                   view.id[view.index(u, std::min(v + 1, view.height - 1))]});
}

}  // namespace

void SamplingPlan::plan(const RenderedDepth& view, const ViewEdges& edges, int scale, double fx,
                        double reach, std::size_t budget, const Executor& executor) {
  density_.columns = (view.width + kCell - 1) / kCell;
  density_.rows = (view.height + kCell - 1) / kCell;
  density_.scale = scale;
  const auto cells =
      static_cast<std::size_t>(density_.columns) * static_cast<std::size_t>(density_.rows);
  shows_model_.assign(cells, 0);
  bands_.resize(static_cast<std::size_t>(density_.rows));
  executor.for_each(bands_.size(), [&](std::size_t row) { count_edges(view, edges, row); });
  score_cells();
  float nearest = std::numeric_limits<float>::infinity();
  for (const Band& band : bands_) nearest = std::min(nearest, band.nearest);
  const double pixels = reach * fx / static_cast<double>(nearest);
  mark_cells_beside(static_cast<int>(std::ceil(std::min(pixels, 1.0 * view.width) / kCell)));
  spend(budget);
}

void SamplingPlan::add_edge(std::uint32_t first_cell, int column, std::int16_t body, Band& band) {
  std::size_t& latest = band.latest[static_cast<std::size_t>(column)];
  if (latest < band.edges.size() && band.edges[latest].body == body) {
    ++band.edges[latest].pixels;
    return;
  }
  latest = band.edges.size();
  band.edges.push_back({first_cell + static_cast<std::uint32_t>(column), body, 1});
}

/// Where the view shows the model, and at which bodies' edges.
void SamplingPlan::count_edges(const RenderedDepth& view, const ViewEdges& edges,
                               std::size_t row_of_cells) {
  Band& band = bands_[row_of_cells];
  band.edges.clear();
  band.latest.assign(static_cast<std::size_t>(density_.columns), kNone);
  band.nearest = std::numeric_limits<float>::infinity();
  const ImageWindow& drawn = view.drawn;
  if (drawn.width == 0) return;
  const int first = static_cast<int>(row_of_cells) * kCell;
  const int first_row = std::max(first, drawn.top - 1);
  const int end_row = std::min({first + kCell, drawn.bottom() + 1, view.height});
  const int last_column = std::min(drawn.right(), view.width - 1);
  std::uint8_t* const shows_model =
      &shows_model_[row_of_cells * static_cast<std::size_t>(density_.columns)];
  const auto first_cell = static_cast<std::uint32_t>(shows_model - shows_model_.data());
  for (int v = first_row; v < end_row; ++v) {
    // Without an edge all pixels of the cell's row show the same.
    const std::int16_t* const id = view.id.data() + view.index(0, v);
    for (int u = std::max(drawn.left - 1, 0) / kCell * kCell; u <= last_column; u += kCell) {
      shows_model[u / kCell] |= static_cast<std::uint8_t>(id[u] != kNothing);
    }
    for (const int u : edges.row(v)) {
      shows_model[u / kCell] = 1;
      add_edge(first_cell, u / kCell, body_at(view, u, v), band);
      band.nearest = std::min(band.nearest, view.depth[view.index(u, v)]);
    }
  }
}

/// All edges of a body together score 1.
void SamplingPlan::score_cells() {
  edges_of_body_.clear();
  for (const Band& band : bands_) {
    for (const Edges& edges : band.edges) {
      const auto body = static_cast<std::size_t>(edges.body);
      if (body >= edges_of_body_.size()) edges_of_body_.resize(body + 1, 0);
      edges_of_body_[body] += edges.pixels;
    }
  }
  scores_.assign(shows_model_.size(), 0.0F);
  edge_cells_.clear();
  for (const Band& band : bands_) {
    for (const Edges& edges : band.edges) {
      if (scores_[edges.cell] == 0.0F) edge_cells_.push_back(edges.cell);
      scores_[edges.cell] +=
          static_cast<float>(edges.pixels) /
          static_cast<float>(edges_of_body_[static_cast<std::size_t>(edges.body)]);
    }
  }
}

/// Marks those up to so many cells away, along rows and then along columns.
void SamplingPlan::mark_cells_beside(int cells) {
  const int columns = density_.columns;
  const int rows = density_.rows;
  const auto at = [columns](int c, int r) { return static_cast<std::size_t>(r * columns + c); };
  density_.spacing.assign(shows_model_.size(), 0);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      if (shows_model_[at(c, r)] == 0) continue;
      for (int k = std::max(c - cells, 0); k <= std::min(c + cells, columns - 1); ++k) {
        density_.spacing[at(k, r)] = kCoarsest;
      }
    }
  }
  is_beside_ = density_.spacing;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      if (is_beside_[at(c, r)] == 0) continue;
      for (int k = std::max(r - cells, 0); k <= std::min(r + cells, rows - 1); ++k) {
        density_.spacing[at(c, k)] = kCoarsest;
      }
    }
  }
}

void SamplingPlan::spend(std::size_t budget) {
  const std::size_t with_edges = edge_cells_.size();
  const auto showing =
      static_cast<std::size_t>(std::count(shows_model_.begin(), shows_model_.end(), 1));
  const std::size_t others = showing - std::min(showing, with_edges);
  std::size_t k = 0;
  while (k + 1 < kSpacings.size() && kSpacings[k + 1].samples(with_edges, others) <= budget) ++k;
  const Spacing affordable = kSpacings[k];
  for (std::size_t cell = 0; cell < shows_model_.size(); ++cell) {
    if (shows_model_[cell] != 0) density_.spacing[cell] = affordable.others;
  }
  for (const std::uint32_t cell : edge_cells_) density_.spacing[cell] = affordable.edges;
  if (k + 1 == kSpacings.size()) return;
  const Spacing finer = kSpacings[k + 1];
  const std::size_t price = Spacing::in_a_cell(finer.edges) - Spacing::in_a_cell(affordable.edges);
  const std::size_t spent = affordable.samples(with_edges, others);
  if (price == 0 || spent >= budget) return;
  const std::size_t upgrades = std::min((budget - spent) / price, with_edges);
  std::nth_element(edge_cells_.begin(), edge_cells_.begin() + static_cast<std::ptrdiff_t>(upgrades),
                   edge_cells_.end(), [this](std::uint32_t a, std::uint32_t b) {
                     return scores_[a] != scores_[b] ? scores_[a] > scores_[b] : a < b;
                   });
  for (std::size_t i = 0; i < upgrades; ++i) density_.spacing[edge_cells_[i]] = finer.edges;
}

}  // namespace lockbox
