// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/metrics.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "frame_errors.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/evaluation/nearest_stamp.hpp"

namespace lockbox {
namespace {

std::vector<double> stamps_of(const StatesFile& file, const std::string& name) {
  if (file.states.empty()) throw InputError(name, "has no states to compare");
  std::vector<double> stamps;
  for (const State& state : file.states) {
    if (!stamps.empty() && !(state.stamp > stamps.back())) {
      throw InputError(name, "timestamp " + std::to_string(state.stamp) +
                                 " is not after the one before it; sort the rows by time");
    }
    stamps.push_back(state.stamp);
  }
  return stamps;
}

/// What the bounds say of the frame at a time.
Determined determined_at(double time, double tolerance, const KinematicTree& tree,
                         const std::vector<FrameBound>& bounds, const std::vector<double>& stamps,
                         const Tolerances& tolerances) {
  const auto nearest = nearest_stamp(stamps, time, tolerance);
  if (!nearest) return {false, false, std::vector<bool>(tree.joints.size(), false)};
  return determined_unknowns(tree, bounds[*nearest].sigma, tolerances);
}

bool flagged_unobservable(const Joint& joint, double sigma) {
  const double range =
      joint.type == JointType::continuous ? std::numbers::pi : joint.upper - joint.lower;
  return sigma >= range / 4.0;
}

JointSummary summarize_joint(const KinematicTree& tree, int index,
                             const std::vector<FrameErrors>& frames) {
  const auto j = static_cast<std::size_t>(index);
  std::vector<double> errors;
  JointSummary summary{index, {}, {}};
  for (const FrameErrors& frame : frames) {
    const double error = frame.joints[index];
    const double sigma = frame.joint_sigmas[index];
    if (std::isnan(error)) continue;
    if (frame.determined.joints[j]) {
      errors.push_back(error);
    } else if (!std::isnan(sigma)) {
      ++summary.honesty.frames;
      const bool honest =
          std::abs(error) <= 3.0 * sigma || flagged_unobservable(tree.joints[j], sigma);
      summary.honesty.honest += honest ? 1 : 0;
    }
  }
  summary.errors = summarize(errors);
  return summary;
}

/// Joints that the estimate calls unobservable may be anywhere.
bool within_tolerances(const KinematicTree& tree, const FrameErrors& frame,
                       const Tolerances& tolerances) {
  if (!(frame.translation <= tolerances.translation && frame.rotation <= tolerances.rotation)) {
    return false;
  }
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    const auto index = static_cast<Eigen::Index>(j);
    if (flagged_unobservable(tree.joints[j], frame.joint_sigmas[index])) continue;
    if (!(std::abs(frame.joints[index]) <= tolerances.joint(tree.joints[j].type))) return false;
  }
  return true;
}

StatusCount count_statuses(const KinematicTree& tree, const std::vector<FrameErrors>& frames,
                           const Tolerances& tolerances) {
  StatusCount count;
  for (const FrameErrors& frame : frames) {
    count.add(frame.status == "tracking", within_tolerances(tree, frame, tolerances));
  }
  return count;
}

void summarize_base(Evaluation& evaluation) {
  std::vector<double> translations;
  std::vector<double> rotations;
  for (const FrameErrors& frame : evaluation.frames) {
    if (std::isnan(frame.translation)) continue;
    if (frame.determined.translation) translations.push_back(frame.translation);
    if (frame.determined.rotation) rotations.push_back(frame.rotation);
  }
  evaluation.translation = summarize(translations);
  evaluation.rotation = summarize(rotations);
}

}  // namespace

Evaluation evaluate(const KinematicTree& tree, const StatesFile& estimate,
                    const StatesFile& reference,
                    const std::optional<std::vector<FrameBound>>& bounds,
                    const Tolerances& tolerances, const EqualPoses& equal) {
  const std::vector<double> estimate_stamps = stamps_of(estimate, "estimate");
  const double tolerance = half_frame(stamps_of(reference, "reference"));
  std::vector<double> bound_stamps;
  if (bounds) {
    for (const FrameBound& bound : *bounds) bound_stamps.push_back(bound.stamp);
  }
  const FrameComparison comparison(tree, estimate.extra_columns, equal);
  Evaluation evaluation;
  for (const State& truth : reference.states) {
    const auto nearest = nearest_stamp(estimate_stamps, truth.stamp, tolerance);
    evaluation.unmatched += nearest ? 0 : 1;
    FrameErrors frame = nearest ? comparison.compare(estimate.states[*nearest], truth)
                                : comparison.nothing(truth.stamp);
    frame.determined =
        bounds ? determined_at(truth.stamp, tolerance, tree, *bounds, bound_stamps, tolerances)
               : all_unknowns(tree);
    evaluation.frames.push_back(std::move(frame));
  }
  summarize_base(evaluation);
  for (const int joint : tree.file_order) {
    evaluation.joints.push_back(summarize_joint(tree, joint, evaluation.frames));
  }
  evaluation.statuses = count_statuses(tree, evaluation.frames, tolerances);
  return evaluation;
}

}  // namespace lockbox
