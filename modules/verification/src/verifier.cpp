// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/verification/verifier.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "evidence_constants.hpp"
#include "lockbox/model/motion_scales.hpp"
#include "look.hpp"

namespace lockbox {
namespace {

/// What evidence errs by, as it is chance by which cells a contour runs. Unit: nats. Source: where
/// cells began a pixel later, that of 40 answers in the frames of a real cube and dragon, and in
/// one of a stapler, differed by 3 to 16. Doubled, fewer answers are told from their rivals.
constexpr double kOfChance = 10.0;
/// Cells of each width begin so often elsewhere. Unit: times. Source: not recorded. Doubled,
/// comparisons take twice as long.
constexpr int kBegins = 2;
constexpr std::size_t kWidths = 3;
constexpr std::size_t kUsualWidth = 1;  ///< of them

/// What two widths agree on: the lesser difference, none if each is for another answer.
double agreed(double a, double b) {
  if (a * b <= 0.0) return 0.0;
  return std::abs(a) < std::abs(b) ? a : b;
}

}  // namespace

struct Verifier::Workspace {
  Workspace(const KinematicTree& of, const EvidenceOptions& with)
      : tree(of),
        contour_tolerance(with.contour_tolerance),
        scales(motion_scales(of)),
        look(of, with, evidence::kColumns),
        looks_again{Look(of, with, evidence::kNarrowColumns), Look(of, with, evidence::kColumns),
                    Look(of, with, evidence::kWideColumns)} {}

  Configuration at_ends(const Configuration& configuration) const;
  Evidence evidence_within_tolerance(Look& in, const Configuration& configuration) const;
  /// Adds so much of it, nats, of each.
  void add_evidence(Look& in, std::span<const Configuration> answers, double share,
                    std::vector<double>& nats) const;

  const KinematicTree& tree;
  const double contour_tolerance;
  const Eigen::VectorXd scales;  ///< of each unknown, metres of surface a unit
  Look look;
  std::array<Look, kWidths> looks_again;  ///< by width
};

Verifier::Verifier(const KinematicTree& tree, const EvidenceOptions& options)
    : workspace_(std::make_unique<Workspace>(tree, options)) {}
Verifier::~Verifier() = default;
Verifier::Verifier(Verifier&&) noexcept = default;
Verifier& Verifier::operator=(Verifier&&) noexcept = default;

void Verifier::look_at(const TiledCloud& cloud, const SensorNoise& sensor,
                       const Executor& executor) {
  workspace_->look.look_at(cloud, sensor, executor);
}

Evidence Verifier::evidence(const Configuration& configuration) {
  return workspace_->look.evidence(configuration);
}

Evidence Verifier::evidence_within_tolerance(const Configuration& configuration) {
  return workspace_->evidence_within_tolerance(workspace_->look, configuration);
}

std::vector<double> Verifier::compare(const TiledCloud& cloud, const SensorNoise& sensor,
                                      const Executor& executor,
                                      std::span<const Configuration> answers) {
  std::array<std::vector<double>, kWidths> by_width;
  for (std::size_t width = 0; width < kWidths; ++width) {
    Look& look = workspace_->looks_again[width];
    by_width[width].assign(answers.size(), 0.0);
    for (int begin = 0; begin < kBegins; ++begin) {
      look.look_at(cloud, sensor, executor, static_cast<double>(begin) / kBegins);
      workspace_->add_evidence(look, answers, 1.0 / kBegins, by_width[width]);
    }
  }
  const auto most = [](const std::vector<double>& nats) { return *std::ranges::max_element(nats); };
  const std::vector<double>& usual = by_width[kUsualWidth];
  const std::vector<double>& most_telling = *std::ranges::max_element(by_width, {}, most);
  const auto best = static_cast<std::size_t>(std::ranges::max_element(usual) - usual.begin());
  std::vector<double> compared = usual;
  for (const std::vector<double>& nats : by_width) {
    if (most(nats) < most(most_telling) - kOfChance) continue;
    for (std::size_t i = 0; i < answers.size(); ++i)
      compared[i] = usual[best] + agreed(compared[i] - usual[best], nats[i] - nats[best]);
  }
  return compared;
}

Evidence Verifier::Workspace::evidence_within_tolerance(Look& in,
                                                        const Configuration& configuration) const {
  const Evidence as_it_stands = in.evidence(configuration);
  const Configuration there = at_ends(configuration);
  if (there.q == configuration.q) return as_it_stands;
  const Evidence at_ends = in.evidence(there);
  return at_ends.total() < as_it_stands.total() ? at_ends : as_it_stands;
}

void Verifier::Workspace::add_evidence(Look& in, std::span<const Configuration> answers,
                                       double share, std::vector<double>& nats) const {
  for (std::size_t i = 0; i < answers.size(); ++i)
    nats[i] += share * evidence_within_tolerance(in, answers[i]).total();
}

/// Returns the configuration with the joints that stand near an end of their range there.
Configuration Verifier::Workspace::at_ends(const Configuration& configuration) const {
  Configuration result = configuration;
  for (int v = 0; v < tree.variables(); ++v) {
    const VariableLimits limits = variable_limits(tree, v);
    const double q = configuration.q[v];
    const double end = q - limits.lower < limits.upper - q ? limits.lower : limits.upper;
    if (std::abs(q - end) * scales[unknown_of(v)] < contour_tolerance) result.q[v] = end;
  }
  return result;
}

}  // namespace lockbox
