// SPDX-License-Identifier: BSD-3-Clause
#include "template_matching.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "height_map.hpp"
#include "lockbox/kernels/window_sums.hpp"

namespace lockbox {
namespace {

using Score = std::int16_t;

// Of one cell. The sums over the few thousand cells of a template stay within 16 bits.
constexpr float kExplained = 8.0F;
constexpr float kInRange = 2.0F;  // where joints leave a choice
constexpr float kSeenThrough = -14.0F;
constexpr float kCovered = -1.5F;          // something in front: it may be an occluder
constexpr float kContinues = -6.0F;        // the surface goes on where the model ends
constexpr std::size_t kStride = 3;         // one cell in so many is looked at in the search
constexpr std::size_t kPeaksRefined = 16;  // with all cells
constexpr float kLeast = 0.04F;     // of what all cells explained would score: half hidden sides
constexpr float kOfTheBest = 0.4F;  // so far: weaker peaks are not worth keeping
constexpr int kApart = 1;           // cells, and steps of rotation, between two matches

Score cell_score(const Expectation& expected, float height, float sigma) {
  if (std::isnan(height)) return 0;
  if (expected.nothing) {
    // Standard deviations: noise alone is beyond in one cell of seven.
    const bool continues = std::abs(height - expected.low) < 1.5F * sigma;
    return static_cast<Score>(continues ? kContinues : 0.0F);
  }
  if (height == kBelow && expected.low < -kDeepest) return 0;  // this may be what is expected
  const float above = (height - expected.high) / sigma;
  const float below = (expected.low - height) / sigma;
  const float most = expected.low == expected.high ? kExplained : kInRange;
  const float deviation = std::max({above, below, 0.0F});
  const float fitting = most - kExplained * 0.2F * deviation * deviation;
  return static_cast<Score>(std::max(fitting, above > below ? kCovered : kSeenThrough));
}

/// Truncates: the library's rounding is a call, which took a thirtieth of a search.
int nearest_cell(float position) {
  constexpr int kBeyondAll = 4096;  // makes positions positive; maps are much smaller
  return static_cast<int>(position + (kBeyondAll + 0.5F)) - kBeyondAll;
}

/// The scores of a template laid onto a map, for whole maps of shifts at once.
class Correlation {
 public:
  Correlation(const HeightMap& map, const HeightTemplate& height_template, int margin)
      : map_(map),
        height_template_(height_template),
        margin_(margin),
        columns_(map.width - 2 * margin),
        rows_(map.height - 2 * margin),
        padded_columns_(padded(columns_)),
        next_row_(map.width + padded_columns_ - columns_) {
    for (const Expectation& expectation : height_template.expectations) {
      auto& scores = cell_scores_.emplace_back(cells(next_row_, map.height));
      for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
          const std::size_t cell = map.index(x, y);
          scores[index(x, y)] = cell_score(expectation, map.heights[cell], map.sigmas[cell]);
        }
      }
    }
    sums_.resize(cells(padded_columns_, rows_));
  }

  /// Sums up a template turned by the angle, for all its positions (columns x rows).
  void turn_to(double angle) {
    const auto c = static_cast<float>(std::cos(angle) / map_.cell_size);
    const auto s = static_cast<float>(std::sin(angle) / map_.cell_size);
    windows_.clear();
    for (std::size_t i = 0; i < height_template_.cells.size(); i += kStride) {
      const TemplateCell& cell = height_template_.cells[i];
      const int dx = nearest_cell(c * cell.x - s * cell.y);
      const int dy = nearest_cell(s * cell.x + c * cell.y);
      windows_.push_back(cell_scores_[static_cast<std::size_t>(cell.expectation)].data() +
                         index(margin_ + dx, margin_ + dy));
    }
    kernels::add_windows(
        {windows_, static_cast<std::size_t>(next_row_), static_cast<std::size_t>(padded_columns_),
         static_cast<std::size_t>(rows_)},
        sums_.data());
  }

  int sum(int x, int y) const {
    return int{sums_[cells(padded_columns_, y) + static_cast<std::size_t>(x)]};
  }

  /// The sum over all cells, for one position (cells) and angle.
  int exactly(double angle, double x, double y) const {
    const auto c = static_cast<float>(std::cos(angle) / map_.cell_size);
    const auto s = static_cast<float>(std::sin(angle) / map_.cell_size);
    const auto left = static_cast<float>(x + margin_);
    const auto top = static_cast<float>(y + margin_);
    int sum = 0;
    for (const TemplateCell& cell : height_template_.cells) {
      const int u = nearest_cell(left + c * cell.x - s * cell.y);
      const int v = nearest_cell(top + s * cell.x + c * cell.y);
      if (u < 0 || v < 0 || u >= map_.width || v >= map_.height) continue;
      sum += cell_scores_[static_cast<std::size_t>(cell.expectation)][index(u, v)];
    }
    return sum;
  }

  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  static std::size_t cells(int width, int height) {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  static int padded(int columns) {
    constexpr int kBlock = static_cast<int>(kernels::kWindowBlock);
    return (columns + kBlock - 1) / kBlock * kBlock;
  }
  std::size_t index(int x, int y) const {
    return cells(next_row_, y) + static_cast<std::size_t>(x);
  }

  const HeightMap& map_;
  const HeightTemplate& height_template_;
  int margin_;
  int columns_;
  int rows_;
  int padded_columns_;
  int next_row_;                                 ///< of the scores: the map's width, padded
  std::vector<std::vector<Score>> cell_scores_;  ///< by expectation; 0 in the padding
  std::vector<const Score*> windows_;
  std::vector<Score> sums_;
};

/// Position in cells, turn in steps.
struct Peak {
  int score;
  double turn;
  double x;
  double y;
};

void collect_peaks(const Correlation& correlation, int turn, int least, std::vector<Peak>& peaks) {
  const int columns = correlation.columns();
  const int rows = correlation.rows();
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const int here = correlation.sum(x, y);
      if (here < least) continue;
      const bool is_peak = (x == 0 || correlation.sum(x - 1, y) <= here) &&
                           (y == 0 || correlation.sum(x, y - 1) <= here) &&
                           (x + 1 == columns || correlation.sum(x + 1, y) < here) &&
                           (y + 1 == rows || correlation.sum(x, y + 1) < here);
      if (is_peak) peaks.push_back({here, double(turn), double(x), double(y)});
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
void climb_peak(const Correlation& correlation, double step, Peak& peak) {
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

std::vector<TemplateMatch> match_template(const CoarseView& view, const PlanarRegion& region,
                                          const HeightTemplate& height_template, double noise,
                                          std::size_t most, const StopRequest& stop_request) {
  const Eigen::Isometry3d T_camera_plane = region_frame(view, region);
  const double cell = height_template.cell_size;
  const int margin = static_cast<int>(height_template.radius / cell) + 2;
  // The middle of the template may lie beyond what is seen of it, but not far.
  const HeightMap map =
      height_map(view, region, T_camera_plane, noise, {cell, 0.5 * height_template.radius, margin});
  Correlation correlation(map, height_template, margin);
  const int turns = static_cast<int>(
      std::ceil(std::numbers::pi * height_template.radius / height_template.cell_size));
  const double step = 2.0 * std::numbers::pi / turns;
  auto least = static_cast<int>(kLeast * kExplained / static_cast<float>(kStride) *
                                static_cast<float>(height_template.cells.size()));
  std::vector<Peak> peaks;
  for (int turn = 0; turn < turns; ++turn) {
    stop_if(stop_request);
    correlation.turn_to(step * turn);
    const std::size_t before = peaks.size();
    collect_peaks(correlation, turn, least, peaks);
    for (std::size_t i = before; i < peaks.size(); ++i) {
      least = std::max(least, static_cast<int>(kOfTheBest * static_cast<float>(peaks[i].score)));
    }
  }
  peaks = strongest(std::move(peaks), turns, kPeaksRefined);
  for (Peak& peak : peaks) climb_peak(correlation, step, peak);
  std::vector<TemplateMatch> matches;
  for (const Peak& peak : strongest(std::move(peaks), turns, most)) {
    Eigen::Isometry3d T_plane_template = Eigen::Isometry3d::Identity();
    T_plane_template.linear() =
        Eigen::AngleAxisd(step * peak.turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    T_plane_template.translation().head<2>() =
        map.corner + cell * Eigen::Vector2d(peak.x + margin, peak.y + margin);
    matches.push_back(
        {T_camera_plane * T_plane_template * height_template.T_body_plane.inverse(), peak.score});
  }
  return matches;
}

}  // namespace lockbox
