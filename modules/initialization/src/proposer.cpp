// SPDX-License-Identifier: BSD-3-Clause
#include "proposer.hpp"

#include <algorithm>
#include <utility>

#include "template_matching.hpp"

namespace lockbox {
namespace {

constexpr int kAnchorSteps = 4;          // of a joint between base and a matched body
constexpr double kMatchSlack = 0.02;     // metres that what was just laid onto a plane may be off
constexpr double kMatchTolerance = 1.0;  // nothing is refined
constexpr double kPointTolerance = 0.7;  // bins of pairs are coarse, but of the whole body
/// Places that are drawn: of 32 objects the right one of 29 was among the first 120. Doubled, it
/// takes a tenth of a second longer.
constexpr std::size_t kMostVotes = 300;

}  // namespace

Proposer::Proposer(const SoughtModel& sought, const StopRequest& stop_request,
                   const Executor& executor)
    : sought_(sought),
      stop_request_(stop_request),
      executor_(executor),
      telling_(telling_bodies(sought.model.tree)),
      pairs_(telling_.size()) {}

std::vector<Hypothesis> Proposer::by_sides(SearchImage& image, const PlanarScene& scene,
                                           const Configuration& held, const Breadth& breadth) {
  const auto& regions = scene.regions;
  if (!templates_) {
    templates_ = make_height_templates(sought_.model.tree, executor_, stop_request_);
  }
  if (templates_->empty()) return {};
  const HeightMapSize size = map_size(*templates_);
  std::vector<std::optional<HeightMap>> maps(regions.size());
  executor_.for_each(regions.size(), [&](std::size_t i) {
    maps[i] = height_map(scene.view, regions[i], scene.noise, size);
  });
  const std::size_t trials = regions.size() * templates_->size();
  std::vector<std::vector<Hypothesis>> found(trials);
  executor_.for_each(trials, [&](std::size_t pair) {
    const HeightTemplate& height_template = (*templates_)[pair % templates_->size()];
    const HeightMap& map = *maps[pair / templates_->size()];
    for (const auto& match :
         match_template(map, height_template, breadth.matches_each, stop_request_)) {
      const auto body = static_cast<std::size_t>(height_template.body);
      for (Hypothesis& there :
           with_body_at(sought_, held, body, match.T_camera_body, kAnchorSteps)) {
        score_match(image, held, breadth.is_close, there);
        found[pair].push_back(std::move(there));
      }
    }
  });
  std::vector<Hypothesis> all;
  for (auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return best_apart(std::move(all), breadth.matched, sought_.extent);
}

/// Scores a match by base and matched body alone, or with all others as they are held, if that says
/// more: closed, a cabinet is more than one of its fronts.
void Proposer::score_match(SearchImage& image, const Configuration& held, bool is_close,
                           Hypothesis& hypothesis) const {
  hypothesis.score = image.score(hypothesis, kMatchSlack, kMatchTolerance, is_close);
  if (!(hypothesis.score > 0.0) || hypothesis.configuration.q != held.q) return;
  const Hypothesis whole{hypothesis.configuration, sought_.all_bodies};
  hypothesis.score =
      std::max(hypothesis.score, image.score(whole, kMatchSlack, kMatchTolerance, is_close));
}

std::vector<Hypothesis> Proposer::by_points(SearchImage& image, const Configuration& held,
                                            const Breadth& breadth) {
  std::vector<Hypothesis> found;
  for (const PoseVote& vote : votes(image, 0)) {
    for (Hypothesis& there :
         with_body_at(sought_, held, telling_[0], vote.T_camera_body, kAnchorSteps)) {
      found.push_back(std::move(there));
    }
  }
  return scored(image, breadth, std::move(found));
}

std::vector<Hypothesis> Proposer::by_points_of_others(SearchImage& image, const Configuration& held,
                                                      const Breadth& breadth) {
  std::vector<Hypothesis> found;
  for (std::size_t i = 1; i < telling_.size(); ++i) {
    for (const PoseVote& vote : votes(image, i)) {
      found.push_back(with_body_held(sought_, held, telling_[i], vote.T_camera_body));
    }
  }
  return scored(image, breadth, std::move(found));
}

std::vector<PoseVote> Proposer::votes(SearchImage& image, std::size_t telling) {
  std::optional<BodyPairs>& body = pairs_[telling];
  if (!body) body = make_body_pairs(sought_.model.tree, telling_[telling], executor_);
  const CoarseView& view = image.fine_view();
  const std::vector<float> depth =
      without_wide_planes(view, image.scene(), 2.0 * sought_.extent.radius);
  const auto points =
      points_of_view({view.camera, depth, image.noise().fine}, body->pairs.spacing());
  return body->pairs.vote(points, kMostVotes, executor_, stop_request_);
}

std::vector<Hypothesis> Proposer::scored(SearchImage& image, const Breadth& breadth,
                                         std::vector<Hypothesis> found) const {
  executor_.for_each(found.size(), [&](std::size_t i) {
    found[i].score = image.score(found[i], kMatchSlack, kPointTolerance, breadth.is_close);
  });
  return best_apart(std::move(found), breadth.matched, sought_.extent);
}

}  // namespace lockbox
