// SPDX-License-Identifier: BSD-3-Clause
// The stages of the search without a guess (docs/initialization.md).
#include <algorithm>
#include <optional>

#include "box_turns.hpp"
#include "coordinate_search.hpp"
#include "joint_scan.hpp"
#include "lockbox/model/drawn_mesh.hpp"
#include "lockbox/model/symmetry.hpp"
#include "lockbox/model/variable_range.hpp"
#include "model_extent.hpp"
#include "model_sides.hpp"
#include "search_workspace.hpp"

namespace lockbox {
namespace {

constexpr double kHardlyLess = 0.9;
/// Of the surface: then planes tell more than points. Bottles and mugs have a tenth, furniture and
/// boards eight tenths and more.
constexpr double kMostlyFlat = 0.5;
/// Of the base's surface: a mug's without its handle. Doubled in what it leaves, twice as many
/// turns are tried.
constexpr double kMostlyAlike = 0.75;
constexpr int kAnchorSteps = 4;  // of a joint between base and a matched side

constexpr bool kHoldJoints = true;
constexpr int kRounds = 2;  // gates begin anew where the first round has come

/// Fine steps, with what real objects differ from their models by.
const CoordinateSearchPlan kSearchClosely{{0.004, 0.002, 0.001}, 2, 0.002};

/// Triangles of a body that are drawn in no time.
constexpr std::size_t kFewTriangles = 200;
/// What they may be off by, metres: half a pixel of the finer view at 1 m.
constexpr double kMostOff = 0.0017;

KinematicTree seen_from_afar(const ArticulatedModel& model) {
  KinematicTree tree = model.tree;
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    TriangleMesh& mesh = tree.bodies[b].mesh;
    if (model.fields[b]) mesh = drawn_mesh(mesh, *model.fields[b], kFewTriangles, kMostOff);
  }
  return tree;
}

const AlignOptions kClosely{.annealing_sigma = 0.005, .iterations = 8, .at_edges = false};

}  // namespace

Initializer::Workspace::Workspace(const ArticulatedModel& articulated_model,
                                  const InitializerOptions& given, const Executor& workers)
    : model(articulated_model),
      from_afar(seen_from_afar(articulated_model)),
      options(given),
      executor(workers),
      is_flat(flat_share(model.tree) > kMostlyFlat),
      extent(model_extent(model.tree)),
      symmetries(find_symmetries(model)),
      turns(box_turns(extent, symmetries)),
      surroundings(model.tree),
      held(rest_configuration(model.tree)),
      variables(options.registration.free_variables(model.tree.variables())),
      all_bodies(model.tree.bodies.size(), 1),
      fine(model, options.registration, executor),
      low_prominence(model, options.registration, executor),
      overlap(model, fine.collision()),
      verifier(model.tree) {
  // What is mostly flat is told by its contour.
  const double alike = is_flat ? 1.0 : kMostlyAlike;
  add_turns_of_base(find_base_symmetries(model, alike), symmetries, turns);
  RegistrationOptions coarse_options = options.registration;
  coarse_options.refine_at_edges = false;
  coarse_options.collision = CollisionMode::off;
  coarse_options.match_low_prominence = false;  // coarse pixels err otherwise
  for (int worker = 0; worker < executor.threads(); ++worker) {
    scores.emplace_back(from_afar, view_noise(), options.stop_request);
    halves.emplace_back(from_afar, fine_view_noise(), options.stop_request);
    coarse.emplace_back(model, coarse_options, Executor(1));
    parts.emplace_back();
  }
}

/// The configurations at which that body is there.
void Initializer::Workspace::add_matched(std::size_t body, const Eigen::Isometry3d& T_camera_body,
                                         std::vector<Hypothesis>& hypotheses) const {
  const KinematicTree& tree = model.tree;
  Hypothesis hypothesis{held, std::vector<std::uint8_t>(tree.bodies.size(), 0)};
  // Base and body alone: how other joints stand is not known yet.
  hypothesis.bodies[0] = 1;
  hypothesis.bodies[body] = 1;
  const int joint = tree.bodies[body].parent_joint;
  const int variable = joint < 0 ? -1 : tree.joints[static_cast<std::size_t>(joint)].variable;
  const bool is_free = std::find(variables.begin(), variables.end(), variable) != variables.end();
  std::vector<Eigen::Isometry3d> poses;
  Configuration& configuration = hypothesis.configuration;
  for (const double position : is_free ? positions_in(variable_range(tree, variable), kAnchorSteps)
                                       : std::vector<double>{0.0}) {
    if (is_free) configuration.q[variable] = position;
    configuration.T_camera_base.setIdentity();
    forward_kinematics(tree, configuration, poses);
    configuration.T_camera_base = T_camera_body * poses[body].inverse();
    hypotheses.push_back(hypothesis);
  }
}

std::vector<Hypothesis> Initializer::Workspace::followed(const TiledCloud& cloud,
                                                         std::vector<Hypothesis> hypotheses,
                                                         const Breadth& breadth, double to_beat) {
  place(hypotheses, breadth);
  pose(hypotheses, breadth);
  leave_out_hopeless(to_beat, kGainedFromAfar, breadth.likeliest, hypotheses);
  fit(hypotheses, breadth);
  leave_out_hopeless(to_beat, kGainedFromAfar, breadth.likeliest, hypotheses);
  fit_closely(cloud, hypotheses, breadth);
  leave_out_hopeless(to_beat, kGainedAtLast, breadth.likeliest, hypotheses);
  return hypotheses;
}

std::vector<Hypothesis> Initializer::Workspace::known(
    const std::vector<Configuration>& answers) const {
  std::vector<Hypothesis> hypotheses;
  hypotheses.reserve(answers.size());
  for (const Configuration& answer : answers) hypotheses.push_back({answer, all_bodies, 1.0});
  return hypotheses;
}

/// Flat sides of the model laid onto flat regions of the view.
std::vector<Hypothesis> Initializer::Workspace::match(const PlanarScene& scene,
                                                      const Breadth& breadth) {
  const auto& regions = scene.regions;
  if (!templates) templates = make_height_templates(model.tree, executor, options.stop_request);
  if (templates->empty()) return {};
  const HeightMapSize size = map_size(*templates);
  std::vector<std::optional<HeightMap>> maps(regions.size());
  executor.for_each(regions.size(), [&](std::size_t i) {
    maps[i] = height_map(scene.view, regions[i], scene.noise, size);
  });
  const std::size_t trials = regions.size() * templates->size();
  std::vector<std::vector<Hypothesis>> found(trials);
  executor.for_each(trials, [&](std::size_t pair) {
    const HeightTemplate& height_template = (*templates)[pair % templates->size()];
    const HeightMap& map = *maps[pair / templates->size()];
    for (const auto& match :
         match_template(map, height_template, breadth.matches_each, options.stop_request)) {
      add_matched(static_cast<std::size_t>(height_template.body), match.T_camera_body, found[pair]);
    }
    for (Hypothesis& hypothesis : found[pair]) score_match(breadth.is_close, hypothesis);
  });
  std::vector<Hypothesis> all;
  for (auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return best_apart(std::move(all), breadth.matched, extent);
}

/// By base and matched body alone; or with all others as they are held, if that says more: closed,
/// a cabinet is more than one of its fronts.
void Initializer::Workspace::score_match(bool is_close, Hypothesis& hypothesis) {
  hypothesis.score = score_of(hypothesis, 0.02, 1.0, is_close);
  if (!(hypothesis.score > 0.0) || hypothesis.configuration.q != held.q) return;
  const Hypothesis whole{hypothesis.configuration, all_bodies};
  hypothesis.score = std::max(hypothesis.score, score_of(whole, 0.02, 1.0, is_close));
}

/// Base poses made exact as far as the known bodies tell, and a glance at the joints.
void Initializer::Workspace::place(std::vector<Hypothesis>& hypotheses, const Breadth& breadth) {
  const double slack = breadth.is_close ? 0.008 : 0.02;
  executor.for_each(hypotheses.size(), [&](std::size_t i) {
    Hypothesis refined = hypotheses[i];
    align_coarsely(0.025, 4, refined.configuration, kHoldJoints);
    refined.score = score_of(refined, 0.01, 1.0, breadth.is_close);
    hypotheses[i].score = score_of(hypotheses[i], 0.01, 1.0, breadth.is_close);
    // Joints that stand elsewhere than assumed may have pulled the base away.
    if (refined.score > hypotheses[i].score) hypotheses[i] = std::move(refined);
    hypotheses[i].bodies = all_bodies;
    scan_joints(model.tree, extent, score(), variables, 0.02, kGlance, hypotheses[i].configuration);
    hypotheses[i].score = score_of(hypotheses[i], slack, 0.5, breadth.is_close);
  });
  hypotheses = best_apart(std::move(hypotheses), breadth.placed, extent);
}

/// All joints sought over their ranges, then moved together with the base.
void Initializer::Workspace::pose(std::vector<Hypothesis>& hypotheses, const Breadth& breadth) {
  executor.for_each(hypotheses.size(), [&](std::size_t i) {
    Hypothesis& hypothesis = hypotheses[i];
    scan_joints(model.tree, extent, score(), variables, 0.01, kScan, hypothesis.configuration);
    hypothesis.score = score_closely(hypothesis.configuration, 0.006);
    Hypothesis refined = hypothesis;
    for (int round = 0; round < kRounds; ++round) align_coarsely(0.015, 8, refined.configuration);
    refined.score = score_closely(refined.configuration, 0.006);
    if (refined.score > hypothesis.score) hypothesis = std::move(refined);
  });
  if (breadth.improved) {
    hypotheses = best_apart(std::move(hypotheses), *breadth.improved, extent);
    search_coordinates_of_each(hypotheses);
  }
  hypotheses = best_apart(std::move(hypotheses), breadth.posed, extent);
}

/// All unknowns to where the drawing fits best, where that is better.
void Initializer::Workspace::search_coordinates_of_each(std::vector<Hypothesis>& hypotheses) {
  executor.for_each(hypotheses.size(), [&](std::size_t i) {
    Hypothesis& hypothesis = hypotheses[i];
    Hypothesis improved = hypothesis;
    search_coordinates_far(improved.configuration);
    align_coarsely(0.005, 6, improved.configuration);
    improved.score = score_closely(improved.configuration, 0.006);
    if (improved.score > hypothesis.score) hypothesis = std::move(improved);
  });
}

/// Base and joints together, in the coarse view.
void Initializer::Workspace::fit(std::vector<Hypothesis>& hypotheses, const Breadth& breadth) {
  executor.for_each(hypotheses.size(), [&](std::size_t i) {
    Hypothesis& hypothesis = hypotheses[i];
    Hypothesis refined = hypothesis;
    align_coarsely(0.005, 6, refined.configuration);
    scan_joints(model.tree, extent, score(), variables, 0.004, kScan, refined.configuration);
    refined.score = score_closely(refined.configuration, kFineSlack);
    // What stands before the object may pull a registration along it, but not a drawing.
    Hypothesis improved = hypothesis;
    search_coordinates_far(improved.configuration);
    improved.score = score_closely(improved.configuration, kFineSlack);
    hypothesis.score = score_closely(hypothesis.configuration, kFineSlack);
    if (refined.score > hypothesis.score) hypothesis = std::move(refined);
    if (improved.score > hypothesis.score) hypothesis = std::move(improved);
  });
  hypotheses = best_apart(std::move(hypotheses), breadth.posed, extent);
}

/// The same at full resolution.
void Initializer::Workspace::fit_closely(const TiledCloud& cloud,
                                         std::vector<Hypothesis>& hypotheses,
                                         const Breadth& breadth) {
  align_if_better(cloud, hypotheses, breadth);
  for (Hypothesis& hypothesis : hypotheses) {
    coordinate_search(model.tree, extent, variables, halves, executor, kSearchClosely,
                      hypothesis.configuration);
  }
  align_if_better(cloud, hypotheses, breadth);
}

void Initializer::Workspace::align_if_better(const TiledCloud& cloud,
                                             std::vector<Hypothesis>& hypotheses,
                                             const Breadth& breadth) {
  std::vector<Configuration> aligned;
  aligned.reserve(hypotheses.size());
  for (const Hypothesis& hypothesis : hypotheses) {
    const TiledCloud& object =
        surroundings.left_out_of(cloud, hypothesis.configuration, depth_noise(), parts.front());
    aligned.push_back(align_finely(object, hypothesis.configuration, kClosely).configuration);
  }
  executor.for_each(hypotheses.size(), [&](std::size_t i) {
    Hypothesis& hypothesis = hypotheses[i];
    hypothesis.score = score_closely(hypothesis.configuration, kFineSlack);
    const double score = score_closely(aligned[i], kFineSlack);
    if (score > kHardlyLess * hypothesis.score) {
      hypothesis.configuration = std::move(aligned[i]);
      hypothesis.score = score;
    }
  });
  hypotheses = best_apart(std::move(hypotheses), breadth.posed, extent);  // some have met
}

/// Joints of an object that is known to be there, then all of it once more: what stands before it
/// says nothing about them.
void Initializer::Workspace::rescan_joints(const TiledCloud& cloud, const CoarseView& fine_view,
                                           Candidate& candidate) {
  constexpr bool kIsKnown = true;
  halves.front().set_view(fine_view, kIsKnown);
  Configuration& configuration = candidate.configuration;
  candidate.margins =
      scan_joints(model.tree, extent, halves.front(), variables, kFineSlack, kScan, configuration);
  scan_by_image(low_prominence, cloud, variables, candidate.margins, options.stop_request,
                configuration);
  resolve_overlap(cloud, variables, candidate.margins, configuration);
  align_exactly(cloud, configuration);
}

}  // namespace lockbox
