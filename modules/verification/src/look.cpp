// SPDX-License-Identifier: BSD-3-Clause
#include "look.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "evidence_constants.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/model_bounds.hpp"
#include "lockbox/rendering/body_item.hpp"

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

}  // namespace

Look::Look(const KinematicTree& tree, const EvidenceOptions& options, int columns)
    : tree_(tree),
      options_(options),
      columns_(columns),
      tolerance_(model_tolerance(tree, options)) {}

void Look::look_at(const TiledCloud& cloud, const SensorNoise& sensor, const Executor& executor,
                   double shift) {
  executor_ = executor;
  scene_.emplace(CoarseView(cloud, columns_, executor, shift), sensor, tolerance_, options_);
  if (!renderer_ || !(renderer_->camera() == scene_->camera())) {
    renderer_ = std::make_unique<DepthRenderer>(scene_->camera(), executor);
  }
  scene_lines_.find(*scene_, scene_->cells(), 1.0, executor);
  scene_lines_.join_lines(*scene_);
}

Evidence Look::evidence(const Configuration& configuration) {
  draw(configuration);
  return sum_up();
}

void Look::draw(const Configuration& configuration) {
  forward_kinematics(tree_, configuration, poses_);
  items_.clear();
  for (std::size_t b = 0; b < poses_.size(); ++b) items_.push_back(body_item(tree_, b, poses_[b]));
  renderer_->render(items_, shown_.image);
  const RenderedDepth& image = shown_.image;
  shown_.cells.resize(image.id.size());
  for (std::size_t cell = 0; cell < image.id.size(); ++cell) {
    shown_.cells[cell] = image.id[cell] == kNothing ? 0.0F : 1.0F / image.depth[cell];
  }
  model_lines_.find(*scene_, shown_.cells, 1.0, executor_);
  model_lines_.join_lines(*scene_);
  faint_lines_.find(*scene_, shown_.cells, options_.faint, executor_);
  blurred_lines_.find(*scene_, window_.smear(shown_.cells, scene_->width(), executor_), 1.0,
                      executor_);
}

Evidence Look::sum_up() {
  Evidence evidence = classified_.classify(*scene_, shown_, tree_.bodies.size(), executor_);
  sums_.resize(static_cast<std::size_t>(scene_->height()));
  for (Sums& row : sums_) row.clear();
  const ImageWindow& drawn = shown_.image.drawn;
  constexpr std::size_t kRows = 8;  // a chunk
  const auto rows = static_cast<std::size_t>(std::max(0, drawn.height));
  executor_.for_each_chunk(rows, kRows, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) compare_row(drawn.top + static_cast<int>(i));
  });
  Sums all;
  for (const Sums& row : sums_) all += row;
  evidence += all.evidence;
  for (const FaintSteps::Line& line :
       faint_steps_.weigh(all.unseen, *scene_, shown_, scene_lines_)) {
    const int length = model_lines_.length(line.line);
    const double nats = line.nats / options_.line * worth(options_, length) * line.cells / length;
    (nats > 0.0 ? evidence.matched : evidence.contradicted) += nats;
  }
  evidence.matched = beyond_chance(evidence.matched, all.unmatched, chance_of_a_line());
  return evidence;
}

/// The share of places and directions, on what is seen of the object, at which the model has a
/// line.
double Look::chance_of_a_line() const {
  constexpr int kApart = 2;  // cells: lines are wider
  // As if one had been seen, and one not: few cells know no chance of 0 or 1 (Laplace).
  std::size_t matched = 1;
  std::size_t all = 2;
  const ImageWindow& drawn = shown_.image.drawn;
  for (int v = drawn.top; v < drawn.top + drawn.height; v += kApart) {
    for (int u = drawn.left; u < drawn.right(); u += kApart) {
      if (classified_.at(shown_.index(u, v)) != Seen::explained) continue;
      const int reach = scene_->contour_reach(shown_.at(u, v));
      all += kSights.size();
      for (const Sight& sight : kSights)
        matched += model_lines_.passes(*scene_, u, v, reach, sight.way());
    }
  }
  return static_cast<double>(matched) / static_cast<double>(all);
}

void Look::compare_row(int v) {
  Sums& sum = sums_[static_cast<std::size_t>(v)];
  for (int u = shown_.image.drawn.left; u < shown_.image.drawn.right(); ++u) {
    if (classified_.at(shown_.index(u, v)) == Seen::nothing) continue;
    sum.evidence.occluded += of_occluder(u, v);
    compare_lines(u, v, sum);
  }
}

/// Whether what was measured beyond a contour is known, and does not hide what the model has there.
bool Look::is_in_sight(int u, int v, const Eigen::Vector2f& direction) const {
  const double nearest = scene_->at(u, v) + options_.agree * scene_->deviation(scene_->at(u, v));
  const Eigen::Vector2f way = direction.normalized();
  for (const int beyond : {kSights.front().near, kSights.front().far}) {
    const int at_u = u + static_cast<int>(std::lround(static_cast<float>(beyond) * way.x()));
    const int at_v = v + static_cast<int>(std::lround(static_cast<float>(beyond) * way.y()));
    if (!scene_->contains(at_u, at_v) || !(scene_->at(at_u, at_v) > 0.0)) return false;
    const bool is_hidden = shown_.at(at_u, at_v) > 0.0
                               ? classified_.at(shown_.index(at_u, at_v)) == Seen::occluder
                               : scene_->at(at_u, at_v) > nearest;
    if (is_hidden) return false;
  }
  return true;
}

/// Each line of the scene tells for the model in so far as the model has it, too, and each line of
/// the model against it in so far as the scene goes on there.
void Look::compare_lines(int u, int v, Sums& sum) const {
  const std::size_t cell = shown_.index(u, v);
  if (classified_.at(cell) != Seen::explained) return;
  if (!classified_.tells(shown_.image.id[cell])) return;
  const Eigen::Vector2f& of_scene = scene_lines_.direction(cell);
  const Eigen::Vector2f& of_model = model_lines_.direction(cell);
  const int reach = scene_->contour_reach(shown_.at(u, v));
  if (!of_scene.isZero()) {
    const int length = scene_lines_.cells_of_line(cell);
    const double share = worth(options_, length) / length;
    if (model_lines_.passes(*scene_, u, v, reach, of_scene)) {
      sum.evidence.matched += share;
    } else if (is_in_sight(u, v, of_scene) &&
               !faint_lines_.passes(*scene_, u, v, reach, of_scene)) {
      sum.evidence.contradicted += std::log(options_.unmodelled) / options_.line * share;
      sum.unmatched += share;
    }
  }
  if (!of_model.isZero() && is_in_sight(u, v, of_model) &&
      !scene_lines_.passes(*scene_, u, v, reach, of_model) &&
      !scene_lines_.has_strip(*scene_, u, v, reach) &&
      blurred_lines_.passes(*scene_, u, v, reach, of_model)) {
    sum.unseen.push_back({model_lines_.line(cell), u, v, of_model});
  }
}

/// Returns what an occluder's cell costs.
double Look::of_occluder(int u, int v) const {
  if (classified_.at(shown_.index(u, v)) != Seen::occluder) return 0.0;
  double nats = 0.0;
  for (const auto& [du, dv] :
       {std::pair(1, 0), std::pair(0, 1), std::pair(-1, 0), std::pair(0, -1)}) {
    if (!scene_->contains(u + du, v + dv)) continue;
    const Seen there = classified_.at(shown_.index(u + du, v + dv));
    if (there == Seen::explained || there == Seen::behind) nats -= options_.occluder_edge;
  }
  return nats;
}

}  // namespace lockbox
