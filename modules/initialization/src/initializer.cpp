// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/initialization/initializer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "climb.hpp"
#include "joint_scan.hpp"
#include "lockbox/core/error.hpp"
#include "scene_relief.hpp"

namespace lockbox {
namespace {

constexpr int kColumns = 160;          // of the view that hypotheses are judged in
constexpr double kMedianNoise = 0.6;   // of the noise is left in the median of a block
constexpr int kFineColumns = 320;      // of the view that the best are compared in
constexpr double kFinePixel = 0.0028;  // metres: larger ones are worth looking at one by one
constexpr double kHalfNoise = 0.85;    // the same
constexpr std::size_t kLeastSamples = 20;
constexpr std::size_t kMostRegions = 10;
constexpr std::size_t kMatchesEach = 8;   // of one relief on one region
constexpr std::size_t kMatchesKept = 96;  // whose poses are refined
constexpr std::size_t kPosesKept = 24;    // whose joints are scanned
constexpr std::size_t kScannedKept = 4;   // that are refined together
constexpr double kPromising = 0.15;       // of the best score, before joints are known:
constexpr double kWorthwhile = 0.3;       // and after that: worth another look
constexpr double kApartMetres = 0.04;     // less, and
constexpr double kApartRadians = 0.15;    // less apart, two poses are one
constexpr int kAnchorPositions = 5;       // of a joint between base and a matched side

struct Hypothesis {
  Configuration configuration;
  std::vector<std::uint8_t> bodies;  ///< whose place is known
  double score = 0.0;
};

void check(const TiledCloud& cloud) {
  if (!cloud.has_image()) {
    throw InputError("cloud", "has no image, which the search for the object needs");
  }
}

bool better(const Hypothesis& a, const Hypothesis& b) {
  return a.score > b.score;
}

}  // namespace

struct Initializer::Workspace {
  const ArticulatedModel& model;
  InitializerOptions options;
  Executor executor;
  std::vector<ModelRelief> reliefs;
  std::vector<int> all_variables;
  std::vector<std::uint8_t> all_bodies;
  /// By worker.
  std::vector<ViewScore> scores;
  std::vector<ViewScore> halves;   ///< of a finer view
  std::vector<ViewScore> details;  ///< of single pixels
  std::vector<ArticulatedRegistration> coarse;
  ArticulatedRegistration fine;
  TiledCloud coarse_cloud;

  Workspace(const ArticulatedModel& articulated_model, const InitializerOptions& given,
            const Executor& workers)
      : model(articulated_model),
        options(given),
        executor(workers),
        reliefs(make_reliefs(model.tree, executor)),
        all_variables(static_cast<std::size_t>(model.tree.variables())),
        all_bodies(model.tree.bodies.size(), 1),
        fine(model, options.registration, executor) {
    std::iota(all_variables.begin(), all_variables.end(), 0);
    RegistrationOptions coarse_options = options.registration;
    coarse_options.collision = CollisionMode::off;
    for (int worker = 0; worker < executor.threads(); ++worker) {
      scores.emplace_back(model.tree, kMedianNoise * options.depth_noise);
      halves.emplace_back(model.tree, kHalfNoise * options.depth_noise);
      details.emplace_back(model.tree, options.depth_noise);
      coarse.emplace_back(model, coarse_options, Executor(1));
    }
  }

  std::vector<Hypothesis> matched_poses(const CoarseView& view);
  void add_hypotheses(const ModelRelief& relief, const ReliefMatch& match,
                      std::vector<Hypothesis>& hypotheses) const;
  void refine_base(ArticulatedRegistration& registration, double spread, int iterations,
                   Configuration& configuration) const;
  std::vector<Hypothesis> best_apart(std::vector<Hypothesis> hypotheses, double least_share,
                                     std::size_t most) const;
};

/// The configurations at which the relief's body is where the match says: the joints between base
/// and body may stand anywhere.
void Initializer::Workspace::add_hypotheses(const ModelRelief& relief, const ReliefMatch& match,
                                            std::vector<Hypothesis>& hypotheses) const {
  std::vector<int> path;
  const KinematicTree& tree = model.tree;
  for (int body = relief.body; tree.bodies[static_cast<std::size_t>(body)].parent_joint >= 0;) {
    const Joint& joint = tree.joints[static_cast<std::size_t>(
        tree.bodies[static_cast<std::size_t>(body)].parent_joint)];
    path.push_back(joint.variable);
    body = joint.parent_body;
  }
  // The base alone: how the joints stand is not known yet.
  std::vector<std::uint8_t> bodies(tree.bodies.size(), 0);
  bodies[0] = 1;
  bodies[static_cast<std::size_t>(relief.body)] = 1;
  const int positions = path.empty() ? 1 : kAnchorPositions;
  Configuration configuration = rest_configuration(tree);
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < positions; ++i) {
    if (!path.empty()) {
      const VariableLimits limits = variable_limits(tree, path.front());
      const bool limited = std::isfinite(limits.upper - limits.lower);
      const double share = static_cast<double>(i) / (positions - 1);
      configuration.q[path.front()] =
          limited ? limits.lower + share * (limits.upper - limits.lower) : 6.283185307 * share;
    }
    configuration.T_camera_base.setIdentity();
    forward_kinematics(tree, configuration, poses);
    configuration.T_camera_base =
        match.T_camera_body * poses[static_cast<std::size_t>(relief.body)].inverse();
    hypotheses.push_back({configuration, bodies, 0.0});
  }
}

std::vector<Hypothesis> Initializer::Workspace::matched_poses(const CoarseView& view) {
  const double noise = kMedianNoise * options.depth_noise;
  const auto regions = find_planar_regions(view, noise, kLeastSamples, kMostRegions);
  const std::size_t pairs = regions.size() * reliefs.size();
  std::vector<std::vector<Hypothesis>> found(pairs);
  executor.for_each(pairs, [&](std::size_t pair) {
    const ModelRelief& relief = reliefs[pair % reliefs.size()];
    const PlanarRegion& region = regions[pair / reliefs.size()];
    for (const auto& match : match_relief(view, region, relief, noise, kMatchesEach)) {
      add_hypotheses(relief, match, found[pair]);
    }
    ViewScore& score = scores[Executor::worker()];
    for (Hypothesis& hypothesis : found[pair]) {
      hypothesis.score =
          score.evidence(hypothesis.configuration, 0.02, hypothesis.bodies).total(1.0);
    }
  });
  std::vector<Hypothesis> all;
  for (auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::vector<Hypothesis> Initializer::Workspace::best_apart(std::vector<Hypothesis> hypotheses,
                                                           double least_share,
                                                           std::size_t most) const {
  std::stable_sort(hypotheses.begin(), hypotheses.end(), better);
  std::vector<Hypothesis> kept;
  for (const Hypothesis& hypothesis : hypotheses) {
    const double best = hypotheses.front().score;
    if (best > 0.0 && hypothesis.score < least_share * best) break;
    const bool apart = std::none_of(kept.begin(), kept.end(), [&](const Hypothesis& other) {
      const Eigen::Isometry3d difference =
          other.configuration.T_camera_base.inverse() * hypothesis.configuration.T_camera_base;
      return difference.translation().norm() < kApartMetres &&
             Eigen::AngleAxisd(difference.linear()).angle() < kApartRadians;
    });
    if (apart) kept.push_back(hypothesis);
    if (kept.size() == most) break;
  }
  return kept;
}

void Initializer::Workspace::refine_base(ArticulatedRegistration& registration, double spread,
                                         int iterations, Configuration& configuration) const {
  configuration =
      registration.align(coarse_cloud, configuration, {spread, iterations, true}).configuration;
}

Initializer::Initializer(const ArticulatedModel& model, const InitializerOptions& options,
                         const Executor& executor)
    : workspace_(std::make_unique<Workspace>(model, options, executor)) {}
Initializer::~Initializer() = default;
Initializer::Initializer(Initializer&&) noexcept = default;
Initializer& Initializer::operator=(Initializer&&) noexcept = default;

std::vector<Candidate> Initializer::find(const TiledCloud& cloud) {
  check(cloud);
  Workspace& w = *workspace_;
  const CoarseView view(cloud, kColumns, w.executor);
  CloudOptions unfiltered;
  unfiltered.flying_pixel_jump = 0.0;
  w.coarse_cloud.assign(view.camera, view.depth, unfiltered, w.executor);
  for (ViewScore& score : w.scores) score.set_view(view);

  auto hypotheses = w.best_apart(w.matched_poses(view), kPromising, kMatchesKept);
  w.executor.for_each(hypotheses.size(), [&](std::size_t i) {
    Hypothesis& hypothesis = hypotheses[i];
    const auto judge = [&](Configuration configuration) {
      const double score =
          w.scores[Executor::worker()].evidence(configuration, 0.01, hypothesis.bodies).total(1.0);
      return Hypothesis{std::move(configuration), hypothesis.bodies, score};
    };
    // Joints that stand elsewhere than assumed may pull the base away.
    Configuration refined = hypothesis.configuration;
    w.refine_base(w.coarse[Executor::worker()], 0.025, 4, refined);
    hypothesis = std::max(judge(refined), judge(hypothesis.configuration),
                          [](const auto& x, const auto& y) { return better(y, x); });
  });
  hypotheses = w.best_apart(std::move(hypotheses), kPromising, kPosesKept);
  w.executor.for_each(hypotheses.size(), [&](std::size_t i) {
    ViewScore& score = w.scores[Executor::worker()];
    Hypothesis& hypothesis = hypotheses[i];
    scan_joints(w.model.tree, score, w.all_variables, 0.01, hypothesis.configuration);
    w.refine_base(w.coarse[Executor::worker()], 0.015, 5, hypothesis.configuration);
    scan_joints(w.model.tree, score, w.all_variables, 0.006, hypothesis.configuration);
    hypothesis.score = score.evidence(hypothesis.configuration, 0.006, w.all_bodies).total(0.0);
  });
  hypotheses = w.best_apart(std::move(hypotheses), kWorthwhile, kScannedKept);
  w.executor.for_each(hypotheses.size(), [&](std::size_t i) {
    ViewScore& score = w.scores[Executor::worker()];
    ArticulatedRegistration& registration = w.coarse[Executor::worker()];
    Hypothesis& hypothesis = hypotheses[i];
    hypothesis.configuration =
        registration.align(w.coarse_cloud, hypothesis.configuration, {0.005, 6}).configuration;
    scan_joints(w.model.tree, score, w.all_variables, 0.004, hypothesis.configuration);
    hypothesis.score = score.evidence(hypothesis.configuration, 0.003, w.all_bodies).total(0.0);
  });
  hypotheses = w.best_apart(std::move(hypotheses), kWorthwhile, w.options.most_candidates);
  const CoarseView pixels(cloud, cloud.camera().width, w.executor);
  const CoarseView fine_view(cloud, kFineColumns, w.executor);
  for (ViewScore& score : w.details) score.set_view(pixels);
  for (ViewScore& score : w.halves) score.set_view(fine_view);
  for (Hypothesis& hypothesis : hypotheses) {
    hypothesis.configuration =
        w.fine.align(cloud, hypothesis.configuration, {0.005, 8}).configuration;
  }
  w.executor.for_each(hypotheses.size(), [&](std::size_t i) {
    Configuration& configuration = hypotheses[i].configuration;
    ViewScore& halves = w.halves[Executor::worker()];
    climb(w.model.tree, halves, false, configuration);
    const double pixel = configuration.T_camera_base.translation().z() / cloud.camera().fx;
    scan_joints_by_contrast(w.model.tree,
                            pixel > kFinePixel ? w.details[Executor::worker()] : halves,
                            w.all_variables, configuration);
    // Contrast knows where low relief is better than depth does.
    climb(w.model.tree, halves, true, configuration);
  });
  std::vector<Candidate> candidates;
  for (const Hypothesis& hypothesis : hypotheses) {
    const RegistrationResult& result = w.fine.align(cloud, hypothesis.configuration, {0.0, 0});
    const double score =
        w.scores.front().evidence(result.configuration, 0.003, w.all_bodies).total(0.0);
    if (score > 0.0) candidates.push_back({result.configuration, score, result.agreement});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  return candidates;
}

Configuration Initializer::find_joints(const TiledCloud& cloud, const Configuration& start,
                                       const std::vector<int>& variables) {
  check(cloud);
  Workspace& w = *workspace_;
  const CoarseView view(cloud, kColumns, w.executor);
  constexpr bool kIsKnown = true;
  w.scores.front().set_view(view, kIsKnown);
  Configuration configuration = start;
  scan_joints(w.model.tree, w.scores.front(), variables, 0.01, configuration);
  scan_joints(w.model.tree, w.scores.front(), variables, 0.006, configuration);
  const CoarseView pixels(cloud, cloud.camera().width, w.executor);
  w.details.front().set_view(pixels, kIsKnown);
  scan_joints_by_contrast(w.model.tree, w.details.front(), variables, configuration);
  return configuration;
}

}  // namespace lockbox
