// SPDX-License-Identifier: BSD-3-Clause
// What follows the descent: steps that would lead astray from farther off (docs/mathematics.md).
#include <algorithm>
#include <cmath>

#include "lockbox/registration/articulated_registration.hpp"

namespace lockbox {
namespace {

using Index = Eigen::Index;

/// Points near edges, and outlines, have told before part of what edges tell.
constexpr double kOverlap = 0.5;
constexpr double kSurelyStandsOut = 4.0;  // standard deviations of a depth
constexpr double kPixelsOff = 2.0;        // that points and image may disagree by
constexpr double kMostObjection = 4.5;    // of cost: three standard deviations

}  // namespace

bool ArticulatedRegistration::takes_last_steps(const TiledCloud& cloud) const {
  return options_.lambda_free > 0.0 && cloud.has_image();
}

/// One more step, in which outlines weigh what their pixels are worth. From farther off, such
/// weights would keep the estimate in wrong minima.
void ArticulatedRegistration::refine(const PinholeCamera& camera, bool hold_joints) {
  const double outline_weight = options_.noise_correlation / options_.outline_correlation;
  std::fill(systems_.begin(), systems_.end(), BodySystem{});
  free_term_.add_outlines(outline_weight - options_.lambda_free, systems_);
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    for (NormalEquations* equations : {&data_equations_, &equations_}) {
      equations->add(systems_[b], jacobians_[b], 1.0 / options_.noise_correlation);
    }
  }
  const std::size_t first_tile = view_->has_own_tiles() ? view_->points().tiles().size() : 0;
  free_term_.append_tile_systems(poses_, first_tile, outline_weight, executor_, tile_systems_);
  const Eigen::VectorXd& step = next_step(hold_joints);
  if (moves_.of(step) > surfaces_seen_to_move(camera)) {
    result_.configuration = result_.at_rest;
    return;
  }
  apply_step(step, result_.configuration);
  body_steps_.resize(jacobians_.size());
  for (std::size_t b = 0; b < jacobians_.size(); ++b) {
    body_steps_[b].noalias() = jacobians_[b] * step;
  }
  for (TileSystem& tile : tile_systems_) {
    tile.gradient.noalias() += tile.hessian * body_steps_[static_cast<std::size_t>(tile.body)];
  }
}

/// Before edges add to it.
void ArticulatedRegistration::estimate_covariance() {
  covariance_.estimate(data_equations_, tile_systems_, options_.noise_correlation, jacobians_,
                       scale_, held_);
  for (Index v = 0; v < static_cast<Index>(sightings_.size()); ++v) {
    const auto& sighting = sightings_[static_cast<std::size_t>(v)];
    if (sighting) covariance_.set_independent(6 + v, sighting->variance);
  }
}

/// The last step, from all that has been found: a pixel or less. What is not known yet stays so: a
/// smooth disk has edges, but what they tell about its angle are its facets. poses_
/// stand at the configuration.
void ArticulatedRegistration::refine_at_edges(const TiledCloud& cloud, bool hold_joints) {
  if (!options_.refine_at_edges || !cloud.has_image()) return;
  const std::size_t tiles = view_detail(options_.point_budget).edge_tiles_per_joint;
  if (tiles == 0) return;
  body_jacobians(model_.tree, poses_, jacobians_);
  edges_.linearize(cloud, view_->surface(), view_->continued(), tiles, poses_, jacobians_);
  edge_equations_.information = edges_.information();
  edge_equations_.gradient = edges_.gradient();
  for (Index i = 0; i < scale_.unit.size(); ++i) {
    if (!covariance_.determines(i)) edge_equations_.forget(i);
  }
  equations_.information = kOverlap * covariance_.information() + edge_equations_.information;
  equations_.hessian = equations_.information;
  equations_.gradient = edge_equations_.gradient;
  collision_.evaluate(model_, poses_, &equations_);
  const Eigen::VectorXd& step = next_step(hold_joints);
  if (moves_.of(step) > surfaces_seen_to_move(cloud.camera())) return;
  apply_step(step, result_.configuration);
  edge_equations_.information *= kOverlap;
  covariance_.add_information(edge_equations_.information);
}

/// Metres: what moves farther was not looked for at its outlines.
double ArticulatedRegistration::surfaces_seen_to_move(const PinholeCamera& camera) const {
  const double distance = result_.configuration.T_camera_base.translation().norm();
  return options_.cut * options_.noise.sigma_lateral(distance, camera.fx);
}

/// Farther off than the image errs, and the other terms do not mind: points have pulled the joint
/// along. Where they do mind, what stands out far at places misleads the image, which takes a pixel
/// at an edge for the mean of both sides.
bool ArticulatedRegistration::is_elsewhere(const TiledCloud& cloud, int variable,
                                           const std::optional<JointSighting>& sighting) {
  if (!sighting) return false;
  const double off = std::abs(sighting->position - result_.configuration.q[variable]);
  const double pixel = low_relief_.pixel_step(cloud.camera(), result_.configuration, variable);
  if (off < kPixelsOff * pixel || off < options_.cut * std::sqrt(sighting->variance)) return false;
  candidate_ = result_.configuration;
  candidate_.q[variable] = sighting->position;
  const double objection = cost_at(cloud, candidate_, std::nullopt) -
                           cost_at(cloud, result_.configuration, std::nullopt);
  return objection < kMostObjection;
}

/// Joints of low relief are where the image shows them; what points say about them is noise. Of
/// those that stand out a little more, points say more than the image, unless they are far off.
void ArticulatedRegistration::sight_low_relief(const TiledCloud& cloud) {
  for (int v = 0; v < model_.tree.variables() && options_.sight_low_relief; ++v) {
    const double prominence = low_relief_.prominence(v, result_.configuration);
    if (prominence > kSurelyStandsOut || held_[static_cast<std::size_t>(6 + v)]) continue;
    auto& sighting = sightings_[static_cast<std::size_t>(v)];
    sighting = low_relief_.find_near(cloud, result_.configuration, v, start_[v]);
    if (prominence > options_.free_space_dead_zone && !is_elsewhere(cloud, v, sighting)) {
      sighting.reset();
      continue;
    }
    forget(6 + v);
    if (!sighting) continue;
    result_.configuration.q[v] = sighting->position;
    result_.at_rest.q[v] = sighting->position;
  }
}

/// What the data terms say about an unknown.
void ArticulatedRegistration::forget(Index unknown) {
  data_equations_.forget(unknown);
  for (BodyJacobian& jacobian : jacobians_) jacobian.col(unknown).setZero();
}

}  // namespace lockbox
