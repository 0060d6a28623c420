// SPDX-License-Identifier: BSD-3-Clause
#include "refinement.hpp"

#include <span>
#include <utility>

#include "coordinate_search.hpp"
#include "joint_scan.hpp"

namespace lockbox {
namespace {

/// What an alignment at full resolution must keep of the score to be taken, as a share. Source: not
/// recorded. Doubled, hardly any is taken.
constexpr double kHardlyLess = 0.9;
constexpr int kRounds = 2;            // gates begin anew where the first round has come
constexpr double kFineSlack = 0.003;  // metres that surfaces may be off at last
constexpr double kPoseSlack = 0.006;  // when joints were sought

/// Gates in the coarse view, from wide to narrow.
const AlignOptions kBaseAlone{.annealing_sigma = 0.025, .iterations = 4, .hold_joints = true};
const AlignOptions kWithJoints{.annealing_sigma = 0.015, .iterations = 8};
const AlignOptions kNarrow{.annealing_sigma = 0.005, .iterations = 6};
/// At full resolution.
const AlignOptions kClosely{.annealing_sigma = 0.005, .iterations = 8, .at_edges = false};

/// Coarse steps for a view of coarse pixels.
const CoordinateSearchPlan kSearchFar{{0.03, 0.015, 0.008, 0.004}, 3, 0.006};
/// Fine steps, with what real objects differ from their models by.
const CoordinateSearchPlan kSearchClosely{{0.004, 0.002, 0.001}, 2, 0.002};

RegistrationOptions coarse_options(RegistrationOptions options) {
  options.refine_at_edges = false;
  options.collision = CollisionMode::off;
  options.match_low_prominence = false;  // coarse pixels err otherwise
  return options;
}

/// Takes what has a higher score.
void take_if_better(Hypothesis other, Hypothesis& hypothesis) {
  if (other.score > hypothesis.score) hypothesis = std::move(other);
}

}  // namespace

Refinement::Refinement(const SoughtModel& sought, const InitializerOptions& options,
                       ExactFit& exact, const Executor& executor)
    : sought_(sought), stop_request_(options.stop_request), executor_(executor), exact_(exact) {
  for (int worker = 0; worker < executor.threads(); ++worker) {
    coarse_.emplace_back(sought.model, coarse_options(options.registration), Executor(1));
  }
}

void Refinement::place(SearchImage& image, const Breadth& breadth,
                       std::vector<Hypothesis>& hypotheses) {
  // Metres that surfaces may be off, in the finer view and in the coarse one, once joints were
  // glanced at. Source: not recorded. Doubled, more hypotheses explain as much, wrong ones as well.
  const double slack = breadth.is_close ? 0.008 : 0.02;
  executor_.for_each(hypotheses.size(), [&](std::size_t i) {
    Hypothesis& hypothesis = hypotheses[i];
    Hypothesis refined = hypothesis;
    align_coarsely(image, kBaseAlone, refined.configuration);
    // 10 mm of slack, and all tolerance (ViewEvidence::total), as joints are not known: then 20 mm
    // to scan them, and half the tolerance. Source: not recorded.
    refined.score = image.score(refined, 0.01, 1.0, breadth.is_close);
    hypothesis.score = image.score(hypothesis, 0.01, 1.0, breadth.is_close);
    // Joints that stand elsewhere than assumed may have pulled the base away.
    take_if_better(std::move(refined), hypothesis);
    hypothesis.bodies = sought_.all_bodies;
    scan_joints(sought_.model.tree, sought_.extent, image.coarse_score(), sought_.variables, 0.02,
                kGlance, hypothesis.configuration, hypothesis.held);
    hypothesis.score = image.score(hypothesis, slack, 0.5, breadth.is_close);
  });
  hypotheses = best_apart(std::move(hypotheses), breadth.placed, sought_.extent);
}

void Refinement::pose(SearchImage& image, const Breadth& breadth,
                      std::vector<Hypothesis>& hypotheses) {
  executor_.for_each(hypotheses.size(), [&](std::size_t i) {
    Hypothesis& hypothesis = hypotheses[i];
    // Metres of slack: the base was aligned. Source: not recorded.
    scan_joints(sought_.model.tree, sought_.extent, image.coarse_score(), sought_.variables, 0.01,
                kScan, hypothesis.configuration, hypothesis.held);
    hypothesis.score = image.score_closely(hypothesis.configuration, kPoseSlack);
    Hypothesis refined = hypothesis;
    for (int round = 0; round < kRounds; ++round) {
      align_coarsely(image, kWithJoints, refined.configuration);
    }
    refined.score = image.score_closely(refined.configuration, kPoseSlack);
    take_if_better(std::move(refined), hypothesis);
  });
  if (breadth.improved) {
    hypotheses = best_apart(std::move(hypotheses), *breadth.improved, sought_.extent);
    search_coordinates_of_each(image, hypotheses);
  }
  hypotheses = best_apart(std::move(hypotheses), breadth.posed, sought_.extent);
}

/// All unknowns to where the drawing fits best, where that is better.
void Refinement::search_coordinates_of_each(SearchImage& image,
                                            std::vector<Hypothesis>& hypotheses) {
  executor_.for_each(hypotheses.size(), [&](std::size_t i) {
    Hypothesis improved = hypotheses[i];
    search_coordinates_far(image, improved.configuration);
    align_coarsely(image, kNarrow, improved.configuration);
    improved.score = image.score_closely(improved.configuration, kPoseSlack);
    take_if_better(std::move(improved), hypotheses[i]);
  });
}

void Refinement::fit(SearchImage& image, const Breadth& breadth,
                     std::vector<Hypothesis>& hypotheses) {
  executor_.for_each(hypotheses.size(), [&](std::size_t i) {
    Hypothesis& hypothesis = hypotheses[i];
    Hypothesis refined = hypothesis;
    align_coarsely(image, kNarrow, refined.configuration);
    // Metres of slack: base and joints were aligned. Source: not recorded.
    scan_joints(sought_.model.tree, sought_.extent, image.coarse_score(), sought_.variables, 0.004,
                kScan, refined.configuration);
    refined.score = image.score_closely(refined.configuration, kFineSlack);
    // What stands before the object may pull a registration along it, but not a drawing.
    Hypothesis improved = hypothesis;
    search_coordinates_far(image, improved.configuration);
    improved.score = image.score_closely(improved.configuration, kFineSlack);
    hypothesis.score = image.score_closely(hypothesis.configuration, kFineSlack);
    take_if_better(std::move(refined), hypothesis);
    take_if_better(std::move(improved), hypothesis);
  });
  hypotheses = best_apart(std::move(hypotheses), breadth.posed, sought_.extent);
}

void Refinement::fit_closely(SearchImage& image, const Breadth& breadth,
                             std::vector<Hypothesis>& hypotheses) {
  align_if_better(image, breadth, hypotheses);
  for (Hypothesis& hypothesis : hypotheses) {
    coordinate_search(sought_.model.tree, sought_.extent, sought_.variables, image.fine_scores(),
                      executor_, kSearchClosely, hypothesis.configuration);
  }
  align_if_better(image, breadth, hypotheses);
}

void Refinement::align_if_better(SearchImage& image, const Breadth& breadth,
                                 std::vector<Hypothesis>& hypotheses) {
  std::vector<Configuration> aligned;
  aligned.reserve(hypotheses.size());
  for (const Hypothesis& hypothesis : hypotheses) {
    const TiledCloud& object = image.object(hypothesis.configuration);
    aligned.push_back(exact_.align(object, hypothesis.configuration, kClosely).configuration);
  }
  executor_.for_each(hypotheses.size(), [&](std::size_t i) {
    Hypothesis& hypothesis = hypotheses[i];
    hypothesis.score = image.score_closely(hypothesis.configuration, kFineSlack);
    const double score = image.score_closely(aligned[i], kFineSlack);
    if (score > kHardlyLess * hypothesis.score) {
      hypothesis.configuration = std::move(aligned[i]);
      hypothesis.score = score;
    }
  });
  hypotheses = best_apart(std::move(hypotheses), breadth.posed, sought_.extent);  // some have met
}

void Refinement::align_coarsely(SearchImage& image, const AlignOptions& align_options,
                                Configuration& configuration) {
  stop_if(stop_request_);
  const TiledCloud& object = image.coarse_object(configuration);
  configuration =
      coarse_[Executor::worker()].align(object, configuration, align_options).configuration;
}

/// Moves it to where the drawing in the coarse view fits best.
void Refinement::search_coordinates_far(SearchImage& image, Configuration& configuration) const {
  coordinate_search(sought_.model.tree, sought_.extent, sought_.variables,
                    std::span(&image.coarse_score(), 1), Executor(1), kSearchFar, configuration);
}

}  // namespace lockbox
