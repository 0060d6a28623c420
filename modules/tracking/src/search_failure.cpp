// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/search_failure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "image_belief.hpp"
#include "lockbox/initialization/initializer.hpp"
#include "lockbox/mesh/triangle_mesh.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/symmetry.hpp"
#include "lockbox/sensor/noise_record.hpp"
#include "lockbox/tracking/classification.hpp"
#include "lockbox/verification/belief.hpp"

namespace lockbox {
namespace {

constexpr double kOutliers = 0.02;  // share of the depths, at either end of their range

double model_size(const KinematicTree& tree) {
  Configuration rest = rest_configuration(tree);
  rest.T_camera_base.setIdentity();
  BodyPoses poses;
  forward_kinematics(tree, rest, poses);
  Eigen::AlignedBox3d whole;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    const Eigen::AlignedBox3d box = bounds(tree.bodies[b].mesh);
    if (!box.isEmpty()) whole.extend(box.transformed(poses[b]));
  }
  return whole.isEmpty() ? 0.0 : whole.diagonal().norm();
}

/// Returns the value that this share of them does not exceed; they change places.
double quantile(std::vector<float>& values, double share) {
  const auto last = static_cast<double>(values.size() - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * last);
  std::nth_element(values.begin(), at, values.end());
  return double{*at};
}

/// Sets what the depths tell.
void look_at_depths(const DepthFrame& frame, SearchFailure& failure) {
  std::vector<float> measured;
  std::vector<float> used;
  double near = 0.0;
  for (const std::uint16_t depth : frame.depth) {
    if (depth == 0) continue;
    const float metres = static_cast<float>(depth) * frame.metres_per_unit;
    measured.push_back(metres);
    if (double{metres} < failure.min_depth) {
      near += 1.0;
    } else if (double{metres} <= failure.max_depth) {
      used.push_back(metres);
    }
  }
  if (measured.empty()) return;
  const auto count = static_cast<double>(measured.size());
  failure.measured = count / static_cast<double>(frame.depth.size());
  failure.too_near = near / count;
  failure.too_far = (count - near - static_cast<double>(used.size())) / count;
  failure.median_depth = quantile(measured, 0.5);
  if (used.empty()) return;
  const PinholeCamera& camera = frame.camera;
  const double farthest = quantile(used, 1.0 - kOutliers);
  const double nearest = quantile(used, kOutliers);
  failure.view_size = std::max(camera.width / camera.fx, camera.height / camera.fy) * farthest;
  failure.model_pixels = std::max(camera.fx, camera.fy) * failure.model_size / nearest;
}

SearchFailure::Place place(const RegistrationResult& answer, const KinematicTree& tree,
                           const TrackerOptions& options) {
  SearchFailure::Place place;
  place.distance = answer.configuration.T_camera_base.translation().norm();
  place.explained = answer.agreement.explained;
  place.contradicted = answer.agreement.contradicted;
  place.occluded = answer.agreement.occluded;
  place.continued = answer.contour.continued();
  double most = 0.0;
  for (std::size_t b = 0; b < answer.body_agreement.size(); ++b) {
    const Agreement& body = answer.body_agreement[b];
    if (!is_contradicted(body, options) || body.contradicted <= most) continue;
    most = body.contradicted;
    place.contradicted_body = tree.bodies[b].name;
  }
  return place;
}

DepthFrame mirrored(const DepthFrame& frame) {
  DepthFrame image = frame;
  image.camera.cx = frame.camera.width - 1 - frame.camera.cx;
  for (auto row = image.depth.begin(); row != image.depth.end(); row += frame.camera.width) {
    std::reverse(row, row + frame.camera.width);
  }
  return image;
}

}  // namespace

SearchFailure search_failure(const DepthFrame& frame, const KinematicTree& tree,
                             const TrackerOptions& options, const RegistrationResult* best) {
  SearchFailure failure;
  failure.min_depth = options.cloud.min_depth;
  failure.max_depth = options.cloud.max_depth;
  failure.units_per_metre = 1.0 / double{frame.metres_per_unit};
  failure.camera = frame.camera;
  failure.field_of_view =
      2.0 * std::atan(0.5 * frame.camera.width / frame.camera.fx) * 180.0 / std::numbers::pi;
  failure.model_size = model_size(tree);
  look_at_depths(frame, failure);
  if (const auto noise = estimate_noise(frame))
    failure.noise = noise->sigma_z(failure.median_depth);
  failure.assumed_noise = options.registration.noise.sigma_z(failure.median_depth);
  if (best != nullptr) failure.best = place(*best, tree, options);
  return failure;
}

void try_other_readings(const DepthFrame& frame, const ArticulatedModel& model,
                        const TrackerOptions& options, const Executor& executor,
                        const RegistrationResult* best, SearchFailure& failure) {
  // Its own, so that what the tracker finds later does not depend on what is tried here.
  InitializerOptions of_search{options.registration, options.evidence};
  of_search.stop_request = options.stop_request;
  Initializer initializer(model, of_search, executor);
  ArticulatedRegistration registration(model, options.registration, executor);
  TiledCloud cloud;
  ImageBelief image(model.tree, cloud, options, executor);
  const auto evidence_for = [&](const Configuration& configuration) {
    return image.evidence({&configuration, 1}).front();
  };
  // A model that resembles its mirror image is found in either: the right one is convincing.
  std::vector<double> as_it_is;
  if (best != nullptr) {
    cloud.assign(frame, options.cloud, executor);
    as_it_is.push_back(evidence_for(best->configuration));
  }
  const auto found_in = [&](const DepthFrame& other) -> std::optional<Configuration> {
    cloud.assign(other, options.cloud, executor);
    const auto candidates = initializer.glance(cloud);
    if (candidates.empty()) return std::nullopt;
    // What may as well be elsewhere, or nowhere, tells nothing of the reading.
    if (candidates.front().rival_distance > options.most_rival_distance) return std::nullopt;
    const Answer found =
        registration.align(cloud, candidates.front().configuration,
                           {options.start_joint_sigma, options.start_joint_iterations});
    if (classify(found, options) != TrackingStatus::tracking) return std::nullopt;
    const bool is_convincing = belief(evidence_for(found.configuration), as_it_is,
                                      options.evidence) > options.convincing_belief;
    if (!is_convincing) return std::nullopt;
    return found.configuration;
  };
  const auto in_mirror = found_in(mirrored(frame));
  failure.is_mirrored = in_mirror && !is_own_mirror_image(model, *in_mirror);
  if (failure.is_mirrored || !options.try_other_units) return;
  // Data sets in the manner of TUM's have 5000 units to the metre, most cameras 1000.
  for (const double factor : {5.0, 0.2}) {
    DepthFrame other = frame;
    other.metres_per_unit *= static_cast<float>(factor);
    if (!found_in(other)) continue;
    failure.depth_factor = factor;
    return;
  }
}

}  // namespace lockbox
