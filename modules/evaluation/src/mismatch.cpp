// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/mismatch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lockbox/core/lie.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/simulation/delivery.hpp"
#include "lockbox/simulation/deviating_model.hpp"
#include "lockbox/simulation/simulator.hpp"

namespace lockbox {
namespace {

/// Returns by joint whether the model has a part there, and the object has none.
std::vector<bool> missing_joints(const KinematicTree& tree, const KinematicTree& built) {
  std::vector<bool> missing;
  for (const Joint& joint : tree.joints) {
    const auto child = static_cast<std::size_t>(joint.child_body);
    missing.push_back(!tree.bodies[child].mesh.triangles.empty() &&
                      built.bodies[child].mesh.triangles.empty());
  }
  return missing;
}

bool is_determined(const TrackingResult& result, const Joint& joint) {
  const auto unknown = static_cast<std::size_t>(unknown_of(joint.variable));
  return unknown < result.observable.size() && result.observable[unknown];
}

double base_in_sigmas(const TrackingResult& result, const Eigen::Isometry3d& T_camera_base) {
  if (result.sigma.size() < kBaseUnknowns) return std::numeric_limits<double>::quiet_NaN();
  const Twist error = log_se3(T_camera_base.inverse() * result.configuration.T_camera_base);
  return error.cwiseQuotient(result.sigma.head<6>()).cwiseAbs().maxCoeff();
}

double joint_in_sigmas(const KinematicTree& tree, const TrackingResult& result, const State& truth,
                       const std::vector<bool>& missing) {
  double largest = 0.0;
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    const Joint& joint = tree.joints[j];
    if (joint.is_mimic || missing[j] || !is_determined(result, joint)) continue;
    double error = result.configuration.q[joint.variable] - truth.configuration.q[joint.variable];
    if (joint.type == JointType::continuous) error = std::remainder(error, kFullTurn);
    const double sigma = result.sigma[unknown_of(joint.variable)];
    if (sigma > 0.0) largest = std::max(largest, std::abs(error) / sigma);
  }
  return largest;
}

MismatchFrame compared(const KinematicTree& tree, const TrackingResult& result, const State& truth,
                       const Eigen::Isometry3d& apparent_base, const std::vector<bool>& missing) {
  TrackingResult without_missing = result;
  bool invents_joint = false;
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    if (!missing[j] || !is_determined(result, tree.joints[j])) continue;
    invents_joint = true;
    without_missing.observable[static_cast<std::size_t>(unknown_of(tree.joints[j].variable))] =
        false;
  }
  State apparent = truth;
  apparent.configuration.T_camera_base = apparent_base;
  MismatchFrame frame;
  frame.outcome = compare(tree, without_missing, apparent);
  frame.is_right = frame.outcome.is_right() && !invents_joint;
  const FrameOutcome plain = compare(tree, without_missing, truth);
  frame.plain_translation = plain.translation;
  frame.plain_rotation = plain.rotation;
  const bool is_known = std::isfinite(plain.translation);
  frame.base_in_sigmas = is_known ? base_in_sigmas(result, apparent_base) : plain.translation;
  frame.joint_in_sigmas =
      is_known ? joint_in_sigmas(tree, result, truth, missing) : plain.translation;
  return frame;
}

}  // namespace

std::vector<MismatchFrame> track_mismatch(const ArticulatedModel& model,
                                          const std::vector<State>& run, const Deviation& deviation,
                                          const MismatchSettings& settings,
                                          const Executor& executor) {
  const KinematicTree built =
      deviating_model(model.tree, deviation.object, deviation.seed, executor);
  const std::vector<bool> missing = missing_joints(model.tree, built);
  Simulator simulator(built, settings.camera, PlacedScene(settings.scene, run), settings.sensor,
                      settings.seed, executor, deviation.sensor);
  Tracker tracker(model, settings.tracker);
  std::vector<MismatchFrame> frames;
  DepthFrame image;
  for (const DeliveredFrame& frame : delivered_frames(run, deviation.frames, deviation.seed)) {
    if (!frame.is_repeated) simulator.simulate(frame.state, frames.size(), image);
    image.stamp = frame.state.stamp;
    image.index = frames.size();
    const TrackingResult& result = tracker.process(image);
    frames.push_back(compared(model.tree, result, frame.state, simulator.apparent_base(), missing));
  }
  return frames;
}

}  // namespace lockbox
