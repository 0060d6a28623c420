// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/verification/verifier.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "cell_classification.hpp"
#include "contour_lines.hpp"
#include "evidence_constants.hpp"
#include "faint_steps.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/model_bounds.hpp"
#include "lockbox/model/motion_scales.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "scene_cells.hpp"
#include "sensor_window.hpp"

namespace lockbox {
namespace {

/// Cells at a contour, to each side, that it tells by: those within the reach of a sight.
constexpr double kBand = 5.0;

/// What its object differs by along the ray, standard deviation, metres.
double model_tolerance(const KinematicTree& tree, const EvidenceOptions& options) {
  return std::clamp(
      options.model_tolerance * model_bounds(tree, rest_configuration(tree)).diagonal().norm(),
      options.least_model_tolerance, options.most_model_tolerance);
}

/// Returns what a line of so many cells is worth: less than a stretch of it may be noise.
double worth(const EvidenceOptions& options, int cells) {
  return options.line * std::min(1.0, cells / (options.least_line * kBand));
}

/// What is matched, less what chance matches, as tests are corrected for guessing (Lyerly, A Note
/// on Correcting for Chance Success in Objective Tests, 1951): of lines that have nothing to do
/// with the model it has that share, too, and the others are unmatched. All in nats.
double beyond_chance(double matched, double unmatched, double chance) {
  return std::max(0.0, matched - unmatched * chance / (1.0 - chance));
}

/// Of a row of cells, or of all.
struct Sums {
  Evidence evidence;
  double unmatched = 0.0;          ///< nats of the scene's lines that the model has not
  std::vector<UnseenCell> unseen;  ///< of the model's lines

  void clear() {
    evidence = {};
    unmatched = 0.0;
    unseen.clear();
  }
  Sums& operator+=(const Sums& other) {
    evidence += other.evidence;
    unmatched += other.unmatched;
    unseen.insert(unseen.end(), other.unseen.begin(), other.unseen.end());
    return *this;
  }
};

}  // namespace

struct Verifier::Workspace {
  Workspace(const KinematicTree& of, const EvidenceOptions& with)
      : tree(of), options(with), tolerance(model_tolerance(of, with)), scales(motion_scales(of)) {}

  Configuration at_ends(const Configuration& configuration) const;
  void draw(const Configuration& configuration);
  Evidence sum_up();
  double chance_of_a_line() const;
  void compare_row(int v);
  void compare_lines(int u, int v, Sums& sum) const;
  bool is_in_sight(int u, int v, const Eigen::Vector2f& direction) const;
  double of_occluder(int u, int v) const;

  const KinematicTree& tree;
  const EvidenceOptions options;
  const double tolerance;        ///< of the model, metres
  const Eigen::VectorXd scales;  ///< of each unknown, metres of surface a unit
  Executor executor{1};
  std::optional<SceneCells> scene;
  std::unique_ptr<DepthRenderer> renderer;
  ShownModel shown;
  CellClassification classified;
  ContourLines scene_lines;
  ContourLines model_lines;
  ContourLines faint_lines;  ///< of the model, those that are hardly ones, too
  SensorWindow window;
  ContourLines blurred_lines;  ///< of the model, those that a sensor's window leaves
  FaintSteps faint_steps;
  std::vector<Eigen::Isometry3d> poses;
  std::vector<RenderItem> items;
  std::vector<Sums> sums;  ///< by row
};

Verifier::Verifier(const KinematicTree& tree, const EvidenceOptions& options)
    : workspace_(std::make_unique<Workspace>(tree, options)) {}
Verifier::~Verifier() = default;
Verifier::Verifier(Verifier&&) noexcept = default;
Verifier& Verifier::operator=(Verifier&&) noexcept = default;

void Verifier::look_at(const TiledCloud& cloud, const SensorNoise& sensor,
                       const Executor& executor) {
  Workspace& w = *workspace_;
  w.executor = executor;
  w.scene.emplace(CoarseView(cloud, evidence::kColumns, executor), sensor, w.tolerance, w.options);
  if (!w.renderer || !(w.renderer->camera() == w.scene->camera())) {
    w.renderer = std::make_unique<DepthRenderer>(w.scene->camera(), executor);
  }
  w.scene_lines.find(*w.scene, w.scene->cells(), 1.0, executor);
  w.scene_lines.join_lines(*w.scene);
}

Evidence Verifier::evidence(const Configuration& configuration) {
  workspace_->draw(configuration);
  return workspace_->sum_up();
}

Evidence Verifier::evidence_within_tolerance(const Configuration& configuration) {
  const Evidence as_it_stands = evidence(configuration);
  const Configuration at_ends = workspace_->at_ends(configuration);
  if (at_ends.q == configuration.q) return as_it_stands;
  const Evidence there = evidence(at_ends);
  return there.total() < as_it_stands.total() ? there : as_it_stands;
}

/// Returns the configuration with the joints that stand near an end of their range there.
Configuration Verifier::Workspace::at_ends(const Configuration& configuration) const {
  Configuration result = configuration;
  for (int v = 0; v < tree.variables(); ++v) {
    const VariableLimits limits = variable_limits(tree, v);
    const double q = configuration.q[v];
    const double end = q - limits.lower < limits.upper - q ? limits.lower : limits.upper;
    if (std::abs(q - end) * scales[unknown_of(v)] < options.contour_tolerance) result.q[v] = end;
  }
  return result;
}

void Verifier::Workspace::draw(const Configuration& configuration) {
  forward_kinematics(tree, configuration, poses);
  items.clear();
  for (std::size_t b = 0; b < poses.size(); ++b) items.push_back(body_item(tree, b, poses[b]));
  renderer->render(items, shown.image);
  const RenderedDepth& image = shown.image;
  shown.cells.resize(image.id.size());
  for (std::size_t cell = 0; cell < image.id.size(); ++cell) {
    shown.cells[cell] = image.id[cell] == kNothing ? 0.0F : 1.0F / image.depth[cell];
  }
  model_lines.find(*scene, shown.cells, 1.0, executor);
  model_lines.join_lines(*scene);
  faint_lines.find(*scene, shown.cells, options.faint, executor);
  blurred_lines.find(*scene, window.smear(shown.cells, scene->width(), executor), 1.0, executor);
}

Evidence Verifier::Workspace::sum_up() {
  Evidence evidence = classified.classify(*scene, shown, tree.bodies.size(), executor);
  sums.resize(static_cast<std::size_t>(scene->height()));
  for (Sums& row : sums) row.clear();
  const ImageWindow& drawn = shown.image.drawn;
  constexpr std::size_t kRows = 8;  // a chunk
  const auto rows = static_cast<std::size_t>(std::max(0, drawn.height));
  executor.for_each_chunk(rows, kRows, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) compare_row(drawn.top + static_cast<int>(i));
  });
  Sums all;
  for (const Sums& row : sums) all += row;
  evidence += all.evidence;
  for (const FaintSteps::Line& line : faint_steps.weigh(all.unseen, *scene, shown, scene_lines)) {
    const int length = model_lines.length(line.line);
    const double nats = line.nats / options.line * worth(options, length) * line.cells / length;
    (nats > 0.0 ? evidence.matched : evidence.contradicted) += nats;
  }
  evidence.matched = beyond_chance(evidence.matched, all.unmatched, chance_of_a_line());
  return evidence;
}

/// The share of places and directions, on what is seen of the object, at which the model has a
/// line.
double Verifier::Workspace::chance_of_a_line() const {
  constexpr int kApart = 2;  // cells: lines are wider
  // As if one had been seen, and one not: few cells know no chance of 0 or 1 (Laplace).
  std::size_t matched = 1;
  std::size_t all = 2;
  const ImageWindow& drawn = shown.image.drawn;
  for (int v = drawn.top; v < drawn.top + drawn.height; v += kApart) {
    for (int u = drawn.left; u < drawn.right(); u += kApart) {
      if (classified.at(shown.index(u, v)) != Seen::explained) continue;
      const int reach = scene->contour_reach(shown.at(u, v));
      all += kSights.size();
      for (const Sight& sight : kSights)
        matched += model_lines.passes(*scene, u, v, reach, sight.way());
    }
  }
  return static_cast<double>(matched) / static_cast<double>(all);
}

void Verifier::Workspace::compare_row(int v) {
  Sums& sum = sums[static_cast<std::size_t>(v)];
  for (int u = shown.image.drawn.left; u < shown.image.drawn.right(); ++u) {
    if (classified.at(shown.index(u, v)) == Seen::nothing) continue;
    sum.evidence.occluded += of_occluder(u, v);
    compare_lines(u, v, sum);
  }
}

/// Whether what was measured beyond a contour is known, and does not hide what the model has there.
bool Verifier::Workspace::is_in_sight(int u, int v, const Eigen::Vector2f& direction) const {
  const double nearest = scene->at(u, v) + options.agree * scene->deviation(scene->at(u, v));
  const Eigen::Vector2f way = direction.normalized();
  for (const int beyond : {kSights.front().near, kSights.front().far}) {
    const int at_u = u + static_cast<int>(std::lround(static_cast<float>(beyond) * way.x()));
    const int at_v = v + static_cast<int>(std::lround(static_cast<float>(beyond) * way.y()));
    if (!scene->contains(at_u, at_v) || !(scene->at(at_u, at_v) > 0.0)) return false;
    const bool is_hidden = shown.at(at_u, at_v) > 0.0
                               ? classified.at(shown.index(at_u, at_v)) == Seen::occluder
                               : scene->at(at_u, at_v) > nearest;
    if (is_hidden) return false;
  }
  return true;
}

/// Each line of the scene tells for the model in so far as the model has it, too, and each line of
/// the model against it in so far as the scene goes on there.
void Verifier::Workspace::compare_lines(int u, int v, Sums& sum) const {
  const std::size_t cell = shown.index(u, v);
  if (classified.at(cell) != Seen::explained) return;
  if (!classified.tells(shown.image.id[cell])) return;
  const Eigen::Vector2f& of_scene = scene_lines.direction(cell);
  const Eigen::Vector2f& of_model = model_lines.direction(cell);
  const int reach = scene->contour_reach(shown.at(u, v));
  if (!of_scene.isZero()) {
    const int length = scene_lines.cells_of_line(cell);
    const double share = worth(options, length) / length;
    if (model_lines.passes(*scene, u, v, reach, of_scene)) {
      sum.evidence.matched += share;
    } else if (is_in_sight(u, v, of_scene) && !faint_lines.passes(*scene, u, v, reach, of_scene)) {
      sum.evidence.contradicted += std::log(options.unmodelled) / options.line * share;
      sum.unmatched += share;
    }
  }
  if (!of_model.isZero() && is_in_sight(u, v, of_model) &&
      !scene_lines.passes(*scene, u, v, reach, of_model) &&
      !scene_lines.has_strip(*scene, u, v, reach) &&
      blurred_lines.passes(*scene, u, v, reach, of_model)) {
    sum.unseen.push_back({model_lines.line(cell), u, v, of_model});
  }
}

/// Returns what an occluder's cell costs.
double Verifier::Workspace::of_occluder(int u, int v) const {
  if (classified.at(shown.index(u, v)) != Seen::occluder) return 0.0;
  double nats = 0.0;
  for (const auto& [du, dv] :
       {std::pair(1, 0), std::pair(0, 1), std::pair(-1, 0), std::pair(0, -1)}) {
    if (!scene->contains(u + du, v + dv)) continue;
    const Seen there = classified.at(shown.index(u + du, v + dv));
    if (there == Seen::explained || there == Seen::behind) nats -= options.occluder_edge;
  }
  return nats;
}

}  // namespace lockbox
