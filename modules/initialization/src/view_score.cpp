// SPDX-License-Identifier: BSD-3-Clause
#include "view_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contour_continuation.hpp"
#include "lockbox/kernels/pixel_scores.hpp"
#include "lockbox/rendering/body_item.hpp"

namespace lockbox {
namespace {

constexpr double kSamples = 200.0;  // of each body's surface

std::vector<std::uint8_t> others_than(const std::vector<std::uint8_t>& moved) {
  std::vector<std::uint8_t> others(moved.size());
  std::transform(moved.begin(), moved.end(), others.begin(),
                 [](std::uint8_t is_moved) { return is_moved != 0 ? 0 : 1; });
  return others;
}

}  // namespace

ViewScore::ViewScore(const KinematicTree& tree, double noise, StopRequest stop_request)
    : tree_(tree), noise_(noise), stop_request_(std::move(stop_request)) {
  for (const Body& body : tree.bodies) {
    const double spacing = std::sqrt(surface_area(body.mesh) / kSamples);
    samples_.push_back(spacing > 0.0 ? sample_surface(body.mesh, spacing)
                                     : std::vector<SurfaceSample>{});
    boxes_.push_back(bounds(body.mesh));
  }
}

void ViewScore::set_view(const CoarseView& view, bool is_known) {
  view_ = &view;
  is_known_ = is_known;
  if (!whole_.renderer || !(whole_.renderer->camera() == view.camera)) {
    whole_.renderer = std::make_unique<DepthRenderer>(view.camera, alone_);
  }
}

void ViewScore::draw(const Configuration& configuration, const std::vector<std::uint8_t>& bodies,
                     Drawing& drawing) {
  forward_kinematics(tree_, configuration, poses_);
  draw_bodies(bodies, drawing);
}

/// Where poses_ has them.
void ViewScore::draw_bodies(const std::vector<std::uint8_t>& bodies, Drawing& drawing) {
  stop_if(stop_request_);
  items_.clear();
  for (std::size_t b = 0; b < poses_.size(); ++b) {
    if (bodies[b] != 0) {
      items_.push_back(body_item(tree_, b, poses_[b]));
    }
  }
  drawing.renderer->render(items_, drawing.image);
}

/// Makes moving_ and rest_ show just the part of the view in which the trials show what is drawn of
/// the moved bodies; returns false if that is none. Leaves the poses of the last trial.
bool ViewScore::frame_motion(std::span<const Configuration> trials,
                             const std::vector<std::uint8_t>& moved,
                             const std::vector<std::uint8_t>& drawn) {
  const PinholeCamera& camera = view_->camera;
  Eigen::AlignedBox2d frame;
  nearest_reach_ = std::numeric_limits<double>::infinity();
  const Eigen::AlignedBox2d image(Eigen::Vector2d(0.0, 0.0),
                                  Eigen::Vector2d(camera.width - 1, camera.height - 1));
  forward_kinematics(tree_, trials.front(), poses_);
  for (const Configuration& trial : trials) {
    forward_kinematics_of(tree_, trial, moved, poses_);
    for (std::size_t b = 0; b < drawn.size(); ++b) {
      if (drawn[b] == 0 || boxes_[b].isEmpty()) continue;
      for (int corner = 0; corner < 8; ++corner) {
        const auto type = static_cast<Eigen::AlignedBox3d::CornerType>(corner);
        const Eigen::Vector3d p = poses_[b] * boxes_[b].corner(type);
        nearest_reach_ = std::min(nearest_reach_, p.z());
        if (p.z() < DepthRenderer::kNear) {
          frame = image;
        } else {
          frame.extend(camera.project(p));
        }
      }
    }
  }
  frame.min() -= Eigen::Vector2d::Ones();
  frame.max() += Eigen::Vector2d::Ones();
  frame = frame.intersection(image);
  if (frame.isEmpty()) return false;
  const int left = static_cast<int>(frame.min().x());
  const int top = static_cast<int>(frame.min().y());
  PinholeCamera part = camera;
  part.width = static_cast<int>(frame.max().x()) - left + 1;
  part.height = static_cast<int>(frame.max().y()) - top + 1;
  part.cx -= left;
  part.cy -= top;
  for (Drawing* drawing : {&moving_, &rest_}) {
    drawing->renderer = std::make_unique<DepthRenderer>(part, alone_);
    drawing->left = left;
    drawing->top = top;
  }
  return true;
}

/// All but those at its border, of which the slope is not known. What was measured before
/// everything that the variable can move there says nothing about it; on steep surfaces, of which
/// depths are uncertain, it might seem to.
void ViewScore::score_pixels(double slack, Drawing& drawing) const {
  const RenderedDepth& image = drawing.image;
  const ImageWindow& drawn = image.drawn;
  drawing.scores.assign(image.depth.size(), 0.0F);
  const kernels::PixelScoring scoring{static_cast<float>(noise_),
                                      static_cast<float>(slack),
                                      static_cast<float>(view_->camera.fx),
                                      is_known_ ? static_cast<float>(nearest_reach_ - slack) : 0.0F,
                                      static_cast<float>(ViewEvidence::kOccludedPixel),
                                      static_cast<float>(ViewEvidence::kViolatingPixel)};
  const int first = std::max(drawn.left, 1);
  const int end = std::min(drawn.right(), image.width - 1);
  if (first >= end) return;
  for (int v = std::max(drawn.top, 1); v < std::min(drawn.bottom(), image.height - 1); ++v) {
    const float* depth = &image.depth[image.index(0, v)];
    const std::int16_t* id = &image.id[image.index(0, v)];
    const std::size_t measured = view_->index(drawing.left, v + drawing.top);
    kernels::score_pixels(
        {depth - image.width, depth, depth + image.width}, {id - image.width, id, id + image.width},
        {&view_->depth[measured], &view_->nearest[measured]}, static_cast<std::size_t>(first),
        static_cast<std::size_t>(end), scoring, &drawing.scores[image.index(first, v)]);
  }
}

double ViewScore::share_in_view(const std::vector<std::uint8_t>& bodies) const {
  double facing = 0.0;
  double inside = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b] == 0) continue;
    for (const SurfaceSample& sample : samples_[b]) {
      const Eigen::Vector3d p = poses_[b] * sample.position;
      const double towards = -p.normalized().dot(poses_[b].linear() * sample.normal);
      if (towards <= 0.0) continue;
      const double weight = towards * sample.area;
      facing += weight;
      // Metres: behind the camera, or so near that nothing is drawn of it.
      if (p.z() < 0.05) continue;
      const Eigen::Vector2d image = view_->camera.project(p);
      const auto u = static_cast<int>(std::lround(image.x()));
      const auto v = static_cast<int>(std::lround(image.y()));
      if (view_->contains(u, v)) inside += weight;
    }
  }
  return facing > 0.0 ? inside / facing : 0.0;
}

/// Counts the pixels of what whole_ shows.
ViewEvidence ViewScore::count_pixels() const {
  const RenderedDepth& image = whole_.image;
  const ImageWindow& drawn = image.drawn;
  ViewEvidence evidence;
  for (int v = drawn.top; v < drawn.bottom(); ++v) {
    for (int u = drawn.left; u < drawn.right(); ++u) {
      const std::size_t pixel = image.index(u, v);
      if (image.id[pixel] == kNothing || !(view_->depth[pixel] > 0.0F)) continue;
      const auto score = static_cast<double>(whole_.scores[pixel]);
      evidence.measured += 1.0;
      if (score > 0.0) {
        evidence.explained += score;
      } else if (view_->depth[pixel] > image.depth[pixel]) {
        evidence.contradicted += score / ViewEvidence::kViolatingPixel;
      } else {
        evidence.occluded += score / ViewEvidence::kOccludedPixel;
      }
    }
  }
  return evidence;
}

ViewEvidence ViewScore::evidence(const Configuration& configuration, double slack,
                                 const std::vector<std::uint8_t>& bodies) {
  nearest_reach_ = 0.0;
  draw(configuration, bodies, whole_);
  score_pixels(slack, whole_);
  ViewEvidence evidence = count_pixels();
  evidence.continues = share_that_continues(whole_.image, *view_, noise_, slack);
  evidence.in_view = share_in_view(bodies);
  return evidence;
}

double ViewScore::fit(const Configuration& configuration, double slack) {
  nearest_reach_ = 0.0;
  draw(configuration, std::vector<std::uint8_t>(tree_.bodies.size(), 1), whole_);
  score_pixels(slack, whole_);
  return count_pixels().fit();
}

std::vector<double> ViewScore::scan(std::span<const Configuration> trials,
                                    const std::vector<std::uint8_t>& moved,
                                    const std::vector<std::uint8_t>& left_out, double slack) {
  std::vector<std::uint8_t> drawn = moved;
  std::vector<std::uint8_t> others = others_than(moved);
  for (std::size_t b = 0; b < moved.size(); ++b) {
    if (left_out[b] != 0) drawn[b] = others[b] = 0;
  }
  if (!frame_motion(trials, moved, drawn)) return std::vector<double>(trials.size(), 0.0);
  draw_bodies(others, rest_);
  score_pixels(slack, rest_);
  std::vector<double> scores;
  scores.reserve(trials.size());
  for (const Configuration& trial : trials) {
    forward_kinematics_of(tree_, trial, moved, poses_);
    draw_bodies(drawn, moving_);
    score_pixels(slack, moving_);
    scores.push_back(score_of_moved());
  }
  return scores;
}

/// What the moved bodies explain, less what is explained of what they hide.
double ViewScore::score_of_moved() const {
  const RenderedDepth& image = moving_.image;
  const ImageWindow& drawn = image.drawn;
  double sum = 0.0;
  for (int v = drawn.top; v < drawn.bottom(); ++v) {
    for (int u = drawn.left; u < drawn.right(); ++u) {
      const std::size_t pixel = image.index(u, v);
      if (image.id[pixel] != kNothing && image.depth[pixel] < rest_.image.depth[pixel]) {
        sum += static_cast<double>(moving_.scores[pixel] - rest_.scores[pixel]);
      }
    }
  }
  return sum;
}

}  // namespace lockbox
