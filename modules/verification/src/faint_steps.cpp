// SPDX-License-Identifier: BSD-3-Clause
#include "faint_steps.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "evidence_constants.hpp"

namespace lockbox {
namespace {

/// Cells from a contour at which the surfaces on its two sides are compared: beyond what its
/// tolerance and a sensor's window smear, and as far as a surface is taken to be smooth.
constexpr std::array kDistances{3, 5, 7, 9};
/// Cells within which a line that single cells show is the one that is looked for.
constexpr int kNear = 5;
/// Cells a side of a window, within which a sensor errs alike.
constexpr int kWindow = 4;
static_assert(kWindow * kWindow == static_cast<int>(evidence::kWindow));

/// What a smooth surface with a step in it has: height, two slopes, a bend across the contour, and
/// the step.
using Surface = Eigen::Matrix<double, 5, 1>;
constexpr int kStep = 4;  // where the step is in it
/// Independent measurements of a surface, so that its step is known at all.
constexpr std::size_t kFewestWindows = 2 * Surface::RowsAtCompileTime;

/// Returns the logarithm for a step of that height and standard deviation, against none; any height
/// is as likely.
double log_likelihood_ratio(const EvidenceOptions& options, double height, double deviation) {
  const double against = std::log(options.flush);
  if (!(height > 0.0)) return against;
  const double z = height / deviation;
  const double occam =
      std::log(options.inverse_range / (deviation * std::sqrt(2.0 * std::numbers::pi)));
  return std::clamp(0.5 * z * z - occam, against, options.line);
}

}  // namespace

std::span<const FaintSteps::Line> FaintSteps::weigh(std::span<UnseenCell> cells,
                                                    const SceneCells& scene,
                                                    const ShownModel& model,
                                                    const ContourLines& scene_lines) {
  lines_.clear();
  std::stable_sort(cells.begin(), cells.end(),
                   [](const UnseenCell& a, const UnseenCell& b) { return a.line < b.line; });
  const double against = std::log(scene.options().flush);
  for (auto begin = cells.begin(); begin != cells.end();) {
    const auto end = std::find_if(begin, cells.end(),
                                  [&](const UnseenCell& cell) { return cell.line != begin->line; });
    samples_.clear();
    const auto taken = std::count_if(begin, end, [&](const UnseenCell& cell) {
      return take_samples(cell, scene, model, scene_lines);
    });
    const auto all = static_cast<int>(end - begin);
    const double share = static_cast<double>(taken) / all;
    const double nats = taken > 0 ? nats_of_samples(scene) : against;
    lines_.push_back({begin->line, all, share * nats + (1.0 - share) * against});
    begin = end;
  }
  return lines_;
}

/// True if it lies at the model's contour, and surfaces are seen on both sides.
bool FaintSteps::take_samples(const UnseenCell& cell, const SceneCells& scene,
                              const ShownModel& model, const ContourLines& scene_lines) {
  if (scene_lines.passes(scene, cell.u, cell.v, kNear, cell.direction)) return false;
  const Eigen::Vector2f way = cell.direction.normalized();
  std::array<Sample, 2 * kDistances.size()> samples;
  auto next = samples.begin();
  for (const int distance : kDistances) {
    for (const int side : {-1, 1}) {
      const auto across = static_cast<float>(side * distance);
      const int u = cell.u + static_cast<int>(std::lround(across * way.x()));
      const int v = cell.v + static_cast<int>(std::lround(across * way.y()));
      if (!scene.contains(u, v) || !(scene.at(u, v) > 0.0)) return false;
      const bool is_model = model.at(u, v) > 0.0;
      if (is_model != (side < 0)) return false;
      *next++ = {u, v, across, static_cast<float>(scene.at(u, v))};
    }
  }
  samples_.insert(samples_.end(), samples.begin(), samples.end());
  return true;
}

/// A surface is fitted to both sides of the contour. It errs by what the samples are off, of which
/// those in one window are one.
double FaintSteps::nats_of_samples(const SceneCells& scene) {
  windows_.clear();
  Eigen::Matrix<double, 5, 5> squares = Eigen::Matrix<double, 5, 5>::Zero();
  Surface products = Surface::Zero();
  const auto basis = [&, first = samples_.front()](const Sample& sample) {
    return Surface(1.0, sample.u - first.u, sample.v - first.v, sample.across * sample.across,
                   sample.across < 0.0F ? 1.0 : 0.0);
  };
  for (const Sample& sample : samples_) {
    const Surface at = basis(sample);
    squares += at * at.transpose();
    products += double{sample.value} * at;
    windows_.push_back(sample.v / kWindow * scene.width() + sample.u / kWindow);
  }
  std::sort(windows_.begin(), windows_.end());
  const auto independent =
      static_cast<std::size_t>(std::unique(windows_.begin(), windows_.end()) - windows_.begin());
  if (independent < kFewestWindows) return std::log(scene.options().flush);
  const Eigen::LDLT<Eigen::Matrix<double, 5, 5>> solver(squares);
  const Surface surface = solver.solve(products);
  double residuals = 0.0;
  for (const Sample& sample : samples_) {
    const double off = sample.value - surface.dot(basis(sample));
    residuals += off * off;
  }
  const auto count = static_cast<double>(samples_.size());
  const double noise = scene.noise(double{samples_.front().value});
  const double scatter = std::max(residuals / count, noise * noise);
  const double alike = count / static_cast<double>(independent - Surface::RowsAtCompileTime);
  const double variance = solver.solve(Surface::Unit(kStep))[kStep] * scatter * alike;
  if (!(variance > 0.0)) return std::log(scene.options().flush);
  return log_likelihood_ratio(scene.options(), surface[kStep], std::sqrt(variance));
}

}  // namespace lockbox
