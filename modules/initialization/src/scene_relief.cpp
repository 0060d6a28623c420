// SPDX-License-Identifier: BSD-3-Clause
#include "scene_relief.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "height_map.hpp"

namespace lockbox {
namespace {

using Score = std::int16_t;

// Of one cell. The sums over the few thousand cells of a relief stay within 16 bits.
constexpr float kExplained = 8.0F;
constexpr float kInRange = 2.0F;  // where joints leave a choice
constexpr float kSeenThrough = -14.0F;
constexpr float kCovered = -1.5F;          // something in front: it may be an occluder
constexpr float kContinues = -6.0F;        // the surface goes on where the model ends
constexpr std::size_t kStride = 3;         // one cell in so many is looked at in the search
constexpr std::size_t kPeaksRefined = 16;  // with all cells
constexpr int kApart = 1;                  // cells, and steps of rotation, between two matches

Score cell_score(const Expectation& expected, float height, float sigma) {
  if (std::isnan(height)) return 0;
  if (expected.nothing) {
    const bool continues = std::abs(height - expected.low) < 1.5F * sigma;
    return static_cast<Score>(continues ? kContinues : 0.0F);
  }
  const float above = (height - expected.high) / sigma;
  const float below = (expected.low - height) / sigma;
  const float most = expected.low == expected.high ? kExplained : kInRange;
  const float deviation = std::max({above, below, 0.0F});
  const float fitting = most - kExplained * 0.2F * deviation * deviation;
  return static_cast<Score>(std::max(fitting, above > below ? kCovered : kSeenThrough));
}

class Correlation {
 public:
  Correlation(const HeightMap& map, const ModelRelief& relief, int margin)
      : map_(map),
        relief_(relief),
        margin_(margin),
        columns_(map.width - 2 * margin),
        rows_(map.height - 2 * margin) {
    for (const Expectation& expectation : relief.expectations) {
      auto& scores = cell_scores_.emplace_back(map.heights.size());
      for (std::size_t i = 0; i < scores.size(); ++i) {
        scores[i] = cell_score(expectation, map.heights[i], map.sigmas[i]);
      }
    }
    sums_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  }

  /// The sums for a relief turned by the angle, for all its positions (columns x rows).
  const std::vector<Score>& at(double angle) {
    std::fill(sums_.begin(), sums_.end(), Score{0});
    const auto c = static_cast<float>(std::cos(angle) / map_.cell_size);
    const auto s = static_cast<float>(std::sin(angle) / map_.cell_size);
    for (std::size_t i = 0; i < relief_.cells.size(); i += kStride) {
      const ReliefCell& cell = relief_.cells[i];
      const auto dx = static_cast<int>(std::lround(c * cell.x - s * cell.y));
      const auto dy = static_cast<int>(std::lround(s * cell.x + c * cell.y));
      add(cell_scores_[static_cast<std::size_t>(cell.expectation)], dx, dy);
    }
    return sums_;
  }

  /// The sum over all cells, for one position (cells) and angle.
  int exactly(double angle, double x, double y) const {
    const auto c = static_cast<float>(std::cos(angle) / map_.cell_size);
    const auto s = static_cast<float>(std::sin(angle) / map_.cell_size);
    const auto left = static_cast<float>(x + margin_);
    const auto top = static_cast<float>(y + margin_);
    int sum = 0;
    for (const ReliefCell& cell : relief_.cells) {
      const auto u = static_cast<int>(std::lround(left + c * cell.x - s * cell.y));
      const auto v = static_cast<int>(std::lround(top + s * cell.x + c * cell.y));
      if (u < 0 || v < 0 || u >= map_.width || v >= map_.height) continue;
      sum += cell_scores_[static_cast<std::size_t>(cell.expectation)][map_.index(u, v)];
    }
    return sum;
  }

  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  void add(const std::vector<Score>& scores, int dx, int dy) {
    for (int row = 0; row < rows_; ++row) {
      const Score* from = scores.data() + map_.index(margin_ + dx, row + margin_ + dy);
      Score* to = sums_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
      for (int column = 0; column < columns_; ++column) {
        to[column] = static_cast<Score>(to[column] + from[column]);
      }
    }
  }

  const HeightMap& map_;
  const ModelRelief& relief_;
  int margin_;
  int columns_;
  int rows_;
  std::vector<std::vector<Score>> cell_scores_;
  std::vector<Score> sums_;
};

/// Position in cells, turn in steps.
struct Peak {
  int score;
  double turn;
  double x;
  double y;
};

void collect_peaks(const std::vector<Score>& sums, int columns, int rows, int turn, int least,
                   std::vector<Peak>& peaks) {
  const auto at = [&](int x, int y) {
    return int{sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(x)]};
  };
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const int here = at(x, y);
      if (here < least) continue;
      const bool peak = (x == 0 || at(x - 1, y) <= here) && (y == 0 || at(x, y - 1) <= here) &&
                        (x + 1 == columns || at(x + 1, y) < here) &&
                        (y + 1 == rows || at(x, y + 1) < here);
      if (peak) peaks.push_back({here, double(turn), double(x), double(y)});
    }
  }
}

std::vector<Peak> strongest(std::vector<Peak> peaks, int turns, std::size_t most) {
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.score > b.score; });
  std::vector<Peak> kept;
  for (const Peak& peak : peaks) {
    const bool apart = std::none_of(kept.begin(), kept.end(), [&](const Peak& other) {
      const double turn = std::abs(peak.turn - other.turn);
      return std::min(turn, turns - turn) <= kApart && std::abs(peak.x - other.x) <= kApart &&
             std::abs(peak.y - other.y) <= kApart;
    });
    if (apart) kept.push_back(peak);
    if (kept.size() == most) break;
  }
  return kept;
}

/// To the best of the neighbouring poses, half a step apart, then a quarter.
void climb(const Correlation& correlation, double step, Peak& peak) {
  peak.score = correlation.exactly(step * peak.turn, peak.x, peak.y);
  for (const double reach : {0.5, 0.25}) {
    const Peak centre = peak;
    for (int turn = -1; turn <= 1; ++turn) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          Peak trial{0, centre.turn + reach * turn, centre.x + reach * dx, centre.y + reach * dy};
          trial.score = correlation.exactly(step * trial.turn, trial.x, trial.y);
          if (trial.score > peak.score) peak = trial;
        }
      }
    }
  }
}

}  // namespace

std::vector<ReliefMatch> match_relief(const CoarseView& view, const PlanarRegion& region,
                                      const ModelRelief& relief, double noise, std::size_t most) {
  const Eigen::Isometry3d T_camera_plane = region_frame(view, region);
  const double cell = relief.cell_size;
  const int margin = static_cast<int>(relief.radius / cell) + 2;
  // The middle of the relief may lie beyond what is seen of it, but not far.
  const HeightMap map =
      height_map(view, region, T_camera_plane, noise, {cell, 0.5 * relief.radius, margin});
  Correlation correlation(map, relief, margin);
  const int turns =
      static_cast<int>(std::ceil(std::numbers::pi * relief.radius / relief.cell_size));
  const double step = 2.0 * std::numbers::pi / turns;
  const auto least = static_cast<int>(0.1F * kExplained / static_cast<float>(kStride) *
                                      static_cast<float>(relief.cells.size()));
  std::vector<Peak> peaks;
  for (int turn = 0; turn < turns; ++turn) {
    collect_peaks(correlation.at(step * turn), correlation.columns(), correlation.rows(), turn,
                  least, peaks);
  }
  peaks = strongest(std::move(peaks), turns, kPeaksRefined);
  for (Peak& peak : peaks) climb(correlation, step, peak);
  std::vector<ReliefMatch> matches;
  for (const Peak& peak : strongest(std::move(peaks), turns, most)) {
    Eigen::Isometry3d T_plane_relief = Eigen::Isometry3d::Identity();
    T_plane_relief.linear() =
        Eigen::AngleAxisd(step * peak.turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    T_plane_relief.translation().head<2>() =
        map.corner + cell * Eigen::Vector2d(peak.x + margin, peak.y + margin);
    matches.push_back(
        {T_camera_plane * T_plane_relief * relief.T_body_plane.inverse(), peak.score});
  }
  return matches;
}

}  // namespace lockbox
