// SPDX-License-Identifier: BSD-3-Clause
#include "template_matching.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "template_correlation.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kPeaksRefined = 16;  // with all cells
constexpr float kLeast = 0.04F;     // of what all cells explained would score: half hidden sides
constexpr float kOfTheBest = 0.4F;  // so far: weaker peaks are not worth keeping
/// Between two matches. Unit: cells, and steps of rotation.
constexpr double kApart = 1.0;

/// Position in cells, turn in steps.
struct Peak {
  int score;
  double turn;
  double x;
  double y;
};

void collect_peaks(const TemplateCorrelation& correlation, int turn, int least,
                   std::vector<Peak>& peaks) {
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
      if (is_peak) {
        constexpr double kStep = TemplateCorrelation::kShiftStep;
        peaks.push_back({here, double(turn), kStep * x, kStep * y});
      }
    }
  }
}

std::vector<Peak> strongest(std::vector<Peak> peaks, int turns, double apart, std::size_t most) {
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.score > b.score; });
  std::vector<Peak> kept;
  for (const Peak& peak : peaks) {
    const bool is_apart = std::none_of(kept.begin(), kept.end(), [&](const Peak& other) {
      const double turn = std::abs(peak.turn - other.turn);
      return std::min(turn, turns - turn) <= kApart && std::abs(peak.x - other.x) <= apart &&
             std::abs(peak.y - other.y) <= apart;
    });
    if (is_apart) kept.push_back(peak);
    if (kept.size() == most) break;
  }
  return kept;
}

/// Moves the peak to the best of the neighbouring poses, one unknown after the other, until none is
/// better.
void search_coordinates_of_peak(const TemplateCorrelation& correlation, double step, Peak& peak) {
  const auto score = [&](const Peak& at) {
    return correlation.exactly(step * at.turn, at.x, at.y);
  };
  peak.score = score(peak);
  for (const double reach : {1.0, 0.5, 0.25}) {
    for (double Peak::*const unknown : {&Peak::turn, &Peak::x, &Peak::y}) {
      const Peak centre = peak;
      for (const double way : {-reach, reach}) {
        Peak trial = centre;
        trial.*unknown += way;
        trial.score = score(trial);
        if (trial.score > peak.score) peak = trial;
      }
    }
  }
}

}  // namespace

HeightMapSize map_size(const std::vector<HeightTemplate>& templates) {
  const double cell = templates.front().cell_size;
  double radius = 0.0;
  for (const HeightTemplate& height_template : templates) {
    radius = std::max(radius, height_template.radius);
  }
  // The middle of a template may lie beyond what is seen of it, but not far.
  return {cell, 0.5 * radius, static_cast<int>(radius / cell) + 2};
}

std::vector<TemplateMatch> match_template(const HeightMap& map,
                                          const HeightTemplate& height_template, std::size_t most,
                                          const StopRequest& stop_request) {
  TemplateCorrelation correlation(map, height_template, map.margin);
  const int turns = static_cast<int>(
      std::ceil(std::numbers::pi * height_template.radius / height_template.cell_size));
  const double step = 2.0 * std::numbers::pi / turns;
  auto least = static_cast<int>(kLeast * kExplainedCell /
                                static_cast<float>(TemplateCorrelation::kCellStep) *
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
  peaks = strongest(std::move(peaks), turns, TemplateCorrelation::kShiftStep, kPeaksRefined);
  for (Peak& peak : peaks) search_coordinates_of_peak(correlation, step, peak);
  std::vector<TemplateMatch> matches;
  for (const Peak& peak : strongest(std::move(peaks), turns, kApart, most)) {
    Eigen::Isometry3d T_plane_template = Eigen::Isometry3d::Identity();
    T_plane_template.linear() =
        Eigen::AngleAxisd(step * peak.turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    T_plane_template.translation().head<2>() =
        map.corner + map.cell_size * Eigen::Vector2d(peak.x + map.margin, peak.y + map.margin);
    matches.push_back(
        {map.T_camera_plane * T_plane_template * height_template.T_body_plane.inverse(),
         peak.score});
  }
  return matches;
}

}  // namespace lockbox
