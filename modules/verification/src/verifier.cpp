// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/verification/verifier.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "contour_lines.hpp"
#include "evidence_constants.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/model_bounds.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "scene_cells.hpp"
#include "sensor_window.hpp"

namespace lockbox {
namespace {

enum class Seen : std::uint8_t { nothing, explained, occluder, behind };

/// What the model shows within the tolerance of an outline around a cell, 1/metre.
struct Around {
  double farthest;
  double nearest;
  bool is_at_outline;  ///< it shows nothing in some of these cells

  /// How much nearer a measurement is than all of them; negative: farther; 0: among them.
  double beyond(double inverse_depth) const {
    if (inverse_depth > nearest) return inverse_depth - nearest;
    return std::min(0.0, inverse_depth - farthest);
  }
};

/// Cells at a contour, to each side, that it tells by: those within the reach of a sight.
constexpr double kBand = 5.0;

/// What its object differs by along the ray, standard deviation, metres.
double model_tolerance(const KinematicTree& tree) {
  return std::clamp(
      evidence::kModelTolerance * model_bounds(tree, rest_configuration(tree)).diagonal().norm(),
      evidence::kLeastModelTolerance, evidence::kMostModelTolerance);
}

/// Of a line of so many cells: less than a stretch of it may be noise.
double worth(int cells) {
  return evidence::kLine * std::min(1.0, cells / (evidence::kLeastLine * kBand));
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
  double unmatched = 0.0;  ///< nats of the scene's lines that the model has not

  Sums& operator+=(const Sums& other) {
    evidence += other.evidence;
    unmatched += other.unmatched;
    return *this;
  }
};

/// What lies on the scene's own surface errs, too.
double of_misfit(double misfit) {
  constexpr double kUsual = 2.0;  // standard deviations
  return -0.5 * std::max(0.0, misfit * misfit - kUsual * kUsual) / evidence::kFace;
}

}  // namespace

struct Verifier::Workspace {
  explicit Workspace(const KinematicTree& of) : tree(of), tolerance(model_tolerance(of)) {}

  void draw(const Configuration& configuration);
  Evidence sum_up();
  void judge_row(int v);
  void tell_hidden_bodies();
  double chance_of_a_line() const;
  void compare_row(int v);
  double shown(int u, int v) const { return static_cast<double>(cells[image.index(u, v)]); }
  int outline_reach(double inverse_depth) const;
  Around around(int u, int v) const;
  Seen judge(int u, int v, Evidence& sum) const;
  void compare_lines(int u, int v, Sums& sum) const;
  bool is_in_sight(int u, int v, const Eigen::Vector2f& direction) const;
  double of_occluder(int u, int v) const;

  const KinematicTree& tree;
  const double tolerance;  ///< of the model, metres
  Executor executor{1};
  std::optional<SceneCells> scene;
  std::unique_ptr<DepthRenderer> renderer;
  RenderedDepth image;
  std::vector<float> cells;  ///< what the model shows, 1/metre; 0: nothing
  ContourLines scene_lines;
  ContourLines model_lines;
  ContourLines faint_lines;  ///< of the model, those that are hardly ones, too
  SensorWindow window;
  ContourLines blurred_lines;  ///< of the model, those that a sensor's window leaves
  std::vector<Eigen::Isometry3d> poses;
  std::vector<RenderItem> items;
  std::vector<Seen> seen;
  std::vector<int> explained_cells;   ///< by body
  std::vector<int> hidden_cells;      ///< by body
  std::vector<std::uint8_t> is_mute;  ///< by body: what shows of it may be anything
  std::vector<Sums> sums;             ///< by row
};

Verifier::Verifier(const KinematicTree& tree) : workspace_(std::make_unique<Workspace>(tree)) {}
Verifier::~Verifier() = default;
Verifier::Verifier(Verifier&&) noexcept = default;
Verifier& Verifier::operator=(Verifier&&) noexcept = default;

void Verifier::look_at(const TiledCloud& cloud, double sensor_noise, const Executor& executor) {
  Workspace& w = *workspace_;
  w.executor = executor;
  w.scene.emplace(CoarseView(cloud, evidence::kColumns, executor), sensor_noise, w.tolerance);
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

void Verifier::Workspace::draw(const Configuration& configuration) {
  forward_kinematics(tree, configuration, poses);
  items.clear();
  for (std::size_t b = 0; b < poses.size(); ++b) items.push_back(body_item(tree, b, poses[b]));
  renderer->render(items, image);
  cells.resize(image.id.size());
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    cells[cell] = image.id[cell] == kNothing ? 0.0F : 1.0F / image.depth[cell];
  }
  model_lines.find(*scene, cells, 1.0, executor);
  model_lines.join_lines(*scene);
  faint_lines.find(*scene, cells, evidence::kFaint, executor);
  blurred_lines.find(*scene, window.smear(cells, scene->width(), executor), 1.0, executor);
}

Evidence Verifier::Workspace::sum_up() {
  seen.assign(image.id.size(), Seen::nothing);
  sums.assign(static_cast<std::size_t>(scene->height()), {});
  const ImageWindow& drawn = image.drawn;
  const auto rows = static_cast<std::size_t>(std::max(0, drawn.height));
  constexpr std::size_t kRows = 8;  // a chunk
  executor.for_each_chunk(rows, kRows, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) judge_row(drawn.top + static_cast<int>(i));
  });
  tell_hidden_bodies();
  executor.for_each_chunk(rows, kRows, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) compare_row(drawn.top + static_cast<int>(i));
  });
  Sums all;
  for (const Sums& row : sums) all += row;
  all.evidence.matched = beyond_chance(all.evidence.matched, all.unmatched, chance_of_a_line());
  return all.evidence;
}

void Verifier::Workspace::judge_row(int v) {
  Evidence& sum = sums[static_cast<std::size_t>(v)].evidence;
  for (int u = image.drawn.left; u < image.drawn.right(); ++u) {
    if (!(shown(u, v) > 0.0) || !(scene->at(u, v) > 0.0)) continue;
    ++sum.cells;
    seen[image.index(u, v)] = judge(u, v, sum);
  }
}

/// The base is what is sought, however little of it is seen.
void Verifier::Workspace::tell_hidden_bodies() {
  explained_cells.assign(tree.bodies.size(), 0);
  hidden_cells.assign(tree.bodies.size(), 0);
  const ImageWindow& drawn = image.drawn;
  for (int v = drawn.top; v < drawn.bottom(); ++v) {
    for (int u = drawn.left; u < drawn.right(); ++u) {
      const std::size_t cell = image.index(u, v);
      if (seen[cell] == Seen::nothing) continue;
      const auto body = static_cast<std::size_t>(image.id[cell]);
      explained_cells[body] += seen[cell] == Seen::explained ? 1 : 0;
      hidden_cells[body] += seen[cell] == Seen::occluder ? 1 : 0;
    }
  }
  is_mute.assign(tree.bodies.size(), 0);
  for (std::size_t b = 1; b < is_mute.size(); ++b) {
    const double all = explained_cells[b] + hidden_cells[b];
    is_mute[b] = explained_cells[b] < evidence::kLeastSeen * all ? 1 : 0;
  }
}

/// The share of places and directions, on what is seen of the object, at which the model has a
/// line.
double Verifier::Workspace::chance_of_a_line() const {
  constexpr int kApart = 2;  // cells: lines are wider
  // As if one had been seen, and one not: few cells know no chance of 0 or 1 (Laplace).
  std::size_t matched = 1;
  std::size_t all = 2;
  const ImageWindow& drawn = image.drawn;
  for (int v = drawn.top; v < drawn.top + drawn.height; v += kApart) {
    for (int u = drawn.left; u < drawn.right(); u += kApart) {
      if (seen[image.index(u, v)] != Seen::explained) continue;
      const int reach = outline_reach(shown(u, v));
      all += kSights.size();
      for (const Sight& sight : kSights)
        matched += model_lines.passes(*scene, u, v, reach, sight.way());
    }
  }
  return static_cast<double>(matched) / static_cast<double>(all);
}

void Verifier::Workspace::compare_row(int v) {
  Sums& sum = sums[static_cast<std::size_t>(v)];
  for (int u = image.drawn.left; u < image.drawn.right(); ++u) {
    if (seen[image.index(u, v)] == Seen::nothing) continue;
    sum.evidence.occluded += of_occluder(u, v);
    compare_lines(u, v, sum);
  }
}

/// Cells by which an outline may be off, all told.
int Verifier::Workspace::outline_reach(double inverse_depth) const {
  const double cells_a_metre = scene->camera().fx * inverse_depth;
  return static_cast<int>(std::ceil(evidence::kOutlineTolerance * cells_a_metre +
                                    evidence::kOutlinePixels * scene->width() / 640.0));
}

Around Verifier::Workspace::around(int u, int v) const {
  const double here = shown(u, v);
  const int reach = outline_reach(here);
  Around found{here, here, false};
  for (int dv = -reach; dv <= reach; ++dv) {
    for (int du = -reach; du <= reach; ++du) {
      if (du * du + dv * dv > reach * reach || !scene->contains(u + du, v + dv)) continue;
      const double there = shown(u + du, v + dv);
      found.is_at_outline |= !(there > 0.0);
      if (there > 0.0) found.farthest = std::min(found.farthest, there);
      found.nearest = std::max(found.nearest, there);
    }
  }
  return found;
}

/// Whether what was measured beyond a contour is known, and does not hide what the model has there.
bool Verifier::Workspace::is_in_sight(int u, int v, const Eigen::Vector2f& direction) const {
  const double nearest = scene->at(u, v) + evidence::kAgree * scene->deviation(scene->at(u, v));
  const Eigen::Vector2f way = direction.normalized();
  for (const int beyond : {kSights.front().near, kSights.front().far}) {
    const int at_u = u + static_cast<int>(std::lround(static_cast<float>(beyond) * way.x()));
    const int at_v = v + static_cast<int>(std::lround(static_cast<float>(beyond) * way.y()));
    if (!scene->contains(at_u, at_v) || !(scene->at(at_u, at_v) > 0.0)) return false;
    const bool is_hidden = shown(at_u, at_v) > 0.0 ? seen[image.index(at_u, at_v)] == Seen::occluder
                                                   : scene->at(at_u, at_v) > nearest;
    if (is_hidden) return false;
  }
  return true;
}

/// Each line of the scene tells for the model in so far as the model has it, too, and each line of
/// the model against it in so far as the scene goes on there.
void Verifier::Workspace::compare_lines(int u, int v, Sums& sum) const {
  const std::size_t cell = image.index(u, v);
  if (seen[cell] != Seen::explained) return;
  if (is_mute[static_cast<std::size_t>(image.id[cell])] != 0) return;
  const Eigen::Vector2f& of_scene = scene_lines.direction(cell);
  const Eigen::Vector2f& of_model = model_lines.direction(cell);
  const int reach = outline_reach(shown(u, v));
  if (!of_scene.isZero()) {
    const int length = scene_lines.cells_of_line(cell);
    const double share = worth(length) / length;
    if (model_lines.passes(*scene, u, v, reach, of_scene)) {
      sum.evidence.matched += share;
    } else if (is_in_sight(u, v, of_scene) && !faint_lines.passes(*scene, u, v, reach, of_scene)) {
      sum.evidence.contradicted += std::log(evidence::kUnmodelled) / evidence::kLine * share;
      sum.unmatched += share;
    }
  }
  if (!of_model.isZero() && is_in_sight(u, v, of_model) &&
      !scene_lines.passes(*scene, u, v, reach, of_model) &&
      blurred_lines.passes(*scene, u, v, reach, of_model)) {
    const int length = model_lines.cells_of_line(cell);
    sum.evidence.contradicted +=
        std::log(evidence::kFlush) / evidence::kLine * worth(length) / length;
  }
}

/// Adds what one cell says, unless it is hidden.
Seen Verifier::Workspace::judge(int u, int v, Evidence& sum) const {
  const double cell = scene->at(u, v);
  const double here = shown(u, v);
  const double deviation = scene->deviation(here);
  const double misfit = (cell - here) / deviation;
  if (std::abs(misfit) < evidence::kAgree) {
    sum.misfit += of_misfit(misfit);
    return Seen::explained;
  }
  const Around near = around(u, v);
  const double beyond = near.beyond(cell);
  if (std::abs(beyond) < evidence::kAgree * deviation) {
    sum.misfit += of_misfit(beyond / deviation);
    return Seen::explained;
  }
  if (beyond > 0.0) return Seen::occluder;
  if (near.is_at_outline) return Seen::explained;  // what lies beside the model
  const double anywhere = evidence::kOutliers / evidence::kInverseRange;
  sum.seen_through += std::min(0.0, std::log(anywhere / scene->density(u, v))) / evidence::kWindow;
  return Seen::behind;
}

/// Of an occluder's cell.
double Verifier::Workspace::of_occluder(int u, int v) const {
  if (seen[image.index(u, v)] != Seen::occluder) return 0.0;
  double nats = 0.0;
  for (const auto& [du, dv] :
       {std::pair(1, 0), std::pair(0, 1), std::pair(-1, 0), std::pair(0, -1)}) {
    if (!scene->contains(u + du, v + dv)) continue;
    const Seen there = seen[image.index(u + du, v + dv)];
    if (there == Seen::explained || there == Seen::behind) nats -= evidence::kOccluderEdge;
  }
  return nats;
}

}  // namespace lockbox
