// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/reliability.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lockbox {
namespace {

constexpr std::array<double, 13> kEdges{0.0, 0.1, 0.2, 0.3,  0.4,   0.5, 0.6,
                                        0.7, 0.8, 0.9, 0.99, 0.999, 1.0};
constexpr std::size_t kLeastRuns = 30;
/// What certainty that was wrong costs: as if it had been that probable. 13.8 nats.
constexpr double kLeastProbability = 1e-6;

std::size_t count_right(const std::vector<StatedBelief>& runs) {
  return static_cast<std::size_t>(std::count_if(
      runs.begin(), runs.end(), [](const StatedBelief& run) { return run.is_right; }));
}

double share(std::size_t part, std::size_t of) {
  return of == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(of);
}

}  // namespace

Interval wilson_interval(std::size_t hits, std::size_t runs) {
  if (runs == 0) return {};
  constexpr double kNormal = 1.959963985;  // of 95 %
  const auto n = static_cast<double>(runs);
  const double observed = static_cast<double>(hits) / n;
  const double z2 = kNormal * kNormal / n;
  const double middle = (observed + 0.5 * z2) / (1.0 + z2);
  const double half =
      kNormal * std::sqrt(observed * (1.0 - observed) / n + 0.25 * z2 / n) / (1.0 + z2);
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

bool ReliabilityBin::holds() const {
  return runs < kLeastRuns || (mean_belief >= observed.lower && mean_belief <= observed.upper);
}

std::vector<ReliabilityBin> reliability_bins(const std::vector<StatedBelief>& runs) {
  std::vector<ReliabilityBin> bins;
  for (std::size_t i = 0; i + 1 < kEdges.size(); ++i) {
    bins.push_back({kEdges[i], kEdges[i + 1], 0, 0, 0.0, {}});
  }
  for (const StatedBelief& run : runs) {
    const auto above = std::upper_bound(kEdges.begin(), kEdges.end() - 1, run.belief);
    ReliabilityBin& bin = bins[static_cast<std::size_t>(above - kEdges.begin() - 1)];
    ++bin.runs;
    bin.right += run.is_right ? 1 : 0;
    bin.mean_belief += run.belief;
  }
  for (ReliabilityBin& bin : bins) {
    if (bin.runs > 0) bin.mean_belief /= static_cast<double>(bin.runs);
    bin.observed = wilson_interval(bin.right, bin.runs);
  }
  return bins;
}

Scores scores_of_belief(const std::vector<StatedBelief>& runs) {
  Scores sum;
  for (const StatedBelief& run : runs) {
    const double of_truth = run.is_right ? run.belief : 1.0 - run.belief;
    sum.brier += (1.0 - of_truth) * (1.0 - of_truth);
    sum.log_loss -= std::log(std::max(of_truth, kLeastProbability));
  }
  const auto count = static_cast<double>(std::max<std::size_t>(runs.size(), 1));
  return {sum.brier / count, sum.log_loss / count};
}

Scores scores_of_constant(const std::vector<StatedBelief>& runs) {
  std::vector<StatedBelief> constant = runs;
  for (StatedBelief& run : constant) run.belief = share(count_right(runs), runs.size());
  return scores_of_belief(constant);
}

Scores scores_of_status(const std::vector<StatedBelief>& runs) {
  std::vector<StatedBelief> trusted;
  std::vector<StatedBelief> others;
  for (const StatedBelief& run : runs) (run.is_trusted ? trusted : others).push_back(run);
  std::vector<StatedBelief> by_status = runs;
  for (StatedBelief& run : by_status) {
    const auto& alike = run.is_trusted ? trusted : others;
    run.belief = share(count_right(alike), alike.size());
  }
  return scores_of_belief(by_status);
}

}  // namespace lockbox
