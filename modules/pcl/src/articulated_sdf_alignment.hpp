// SPDX-License-Identifier: BSD-3-Clause
// How ArticulatedSdfRegistration aligns: what PCL's base class expects of computeTransformation.
#pragma once

#include <pcl/console/print.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "lazy_tree.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/pcl/articulated_sdf_registration.hpp"
#include "pcl_points.hpp"
#include "scan_registration.hpp"

namespace lockbox {

inline constexpr double kUsualReach = 0.1;   // metres, where no distance is set
inline constexpr double kWidestReach = 0.5;  // metres, of the fields
inline constexpr int kMaxNarrowing = 20;  // linearisations: more do not find it from farther away
inline constexpr double kRansacThreshold = 0.05;  // metres, PCL's default

/// PCL's carries the last run's mean squared error into the next one, which then ends at once.
template <typename PointT, typename Scalar>
class ArticulatedSdfRegistration<PointT, Scalar>::Criteria : public ConvergenceCriteria {
 public:
  using ConvergenceCriteria::ConvergenceCriteria;

  void restart() {
    this->correspondences_prev_mse_ = std::numeric_limits<double>::max();
    this->iterations_similar_transforms_ = 0;
    this->convergence_state_ = ConvergenceCriteria::CONVERGENCE_CRITERIA_NOT_CONVERGED;
  }
};

template <typename PointT, typename Scalar>
struct ArticulatedSdfRegistration<PointT, Scalar>::State {
  ScanRegistration registration;
  std::shared_ptr<Criteria> criteria;
  typename Base::KdTreePtr tree;
  typename Base::PointRepresentationConstPtr representation;
  typename Base::KdTreeReciprocalPtr reciprocal_tree;
  /// What setIndices() was given. PCL's base class never sees it: before it calls anything that can
  /// be overridden, align() follows its indices, beyond the cloud's end as well. It makes its own,
  /// of all points.
  pcl::IndicesPtr selection;
  std::set<std::string> warned;
};

template <typename PointT, typename Scalar>
bool ArticulatedSdfRegistration<PointT, Scalar>::selects_missing_points() const {
  const pcl::IndicesPtr& selection = state_->selection;
  return selection && std::any_of(selection->begin(), selection->end(), [this](pcl::index_t i) {
           return i < 0 || static_cast<std::size_t>(i) >= input_->size();
         });
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::warn_once(const std::string& setting) {
  if (state_->warned.insert(setting).second) {
    PCL_WARN("[lockbox::%s] No effect here: %s.\n", this->getClassName().c_str(), setting.c_str());
  }
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::restore_search_tree() {
  warn_once("setSearchMethodTarget");
  tree_ = state_->tree;
  this->force_no_recompute_ = false;
  tree_->setInputCloud(target_);
}

/// PCL's setters cannot be overridden, so what they set is looked for at each alignment.
template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::warn_of_ignored_settings() {
  if (tree_ != state_->tree) {
    restore_search_tree();
  }
  if (this->tree_reciprocal_ != state_->reciprocal_tree) {
    warn_once("setSearchMethodSource");
  }
  if (this->transformation_estimation_) {
    warn_once("setTransformationEstimation");
  }
  if (this->correspondence_estimation_) {
    warn_once("setCorrespondenceEstimation");
  }
  if (!this->correspondence_rejectors_.empty()) {
    warn_once("addCorrespondenceRejector");
  }
  if (tree_->getPointRepresentation() != state_->representation) {
    warn_once("setPointRepresentation (but on getFitnessScore)");
  }
  if (this->ransac_iterations_ != 0 || this->inlier_threshold_ != kRansacThreshold) {
    warn_once("setRANSACIterations, setRANSACOutlierRejectionThreshold");
  }
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::computeTransformation(PointCloudSource& output,
                                                                       const Matrix4& guess) {
  warn_of_ignored_settings();
  nr_iterations_ = 0;
  converged_ = false;
  correspondences_->clear();
  Criteria& criteria = *state_->criteria;
  criteria.restart();
  criteria.setMaximumIterations(this->max_iterations_);
  criteria.setRelativeMSE(this->euclidean_fitness_epsilon_);
  criteria.setTranslationThreshold(this->transformation_epsilon_);
  criteria.setRotationThreshold(this->transformation_rotation_epsilon_ > 0.0
                                    ? this->transformation_rotation_epsilon_
                                    : 1.0 - this->transformation_epsilon_);
  if (begin(guess)) {
    find_configuration();
  }
  output = *input_;
  transform(*input_, output, final_transformation_);
}

template <typename PointT, typename Scalar>
bool ArticulatedSdfRegistration<PointT, Scalar>::begin(const Matrix4& guess) {
  const std::optional<Eigen::Isometry3d> T_base_cloud = rigid(guess);
  if (!T_base_cloud) {
    PCL_ERROR("[lockbox::%s] The guess is no rigid motion.\n", this->getClassName().c_str());
    return false;
  }
  final_transformation_ = guess;
  if (!state_->registration.has_model()) {
    PCL_ERROR("[lockbox::%s] There is no model; call setModel.\n", this->getClassName().c_str());
    return false;
  }
  if (selects_missing_points()) {
    PCL_ERROR(
        "[lockbox::%s] The indices select points that the source does not have; call setIndices "
        "with those of this source, or with a null pointer for all points.\n",
        this->getClassName().c_str());
    return false;
  }
  const Scan scan = to_scan(*input_, state_->selection.get());
  const bool is_image = state_->registration.begin(scan, *T_base_cloud);
  if (input_->isOrganized() && !is_image) {
    warn_once("rows and columns of a cloud whose points lie on no rays of the camera");
  }
  return pair_up();
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::find_configuration() {
  ScanRegistration& registration = state_->registration;
  AlignOptions align_options;
  align_options.annealing_sigma = reach() / registration.options().gate;
  align_options.iterations = std::max(1, this->max_iterations_);
  align_options.narrowing = std::clamp(2 * align_options.iterations / 3, 1, kMaxNarrowing);
  align_options.on_iteration = [this](const Configuration& configuration, bool is_narrow) {
    return go_on(configuration, is_narrow);
  };
  const bool came_to_rest = registration.align(align_options);
  if (state_->criteria->getConvergenceState() ==
      ConvergenceCriteria::CONVERGENCE_CRITERIA_NO_CORRESPONDENCES) {
    return;
  }
  if (came_to_rest && !converged_) {
    state_->criteria->setConvergenceState(ConvergenceCriteria::CONVERGENCE_CRITERIA_TRANSFORM);
    converged_ = true;
  }
  registration.accept();
  // The last step is not reported as an iteration.
  final_transformation_ = registration.T_base_cloud().matrix().template cast<Scalar>();
  pose_target(registration.joints());
}

/// After each linearisation, as IterativeClosestPoint does after each of its own.
template <typename PointT, typename Scalar>
bool ArticulatedSdfRegistration<PointT, Scalar>::go_on(const Configuration& configuration,
                                                       bool is_narrow) {
  ScanRegistration& registration = state_->registration;
  const Eigen::Isometry3d T_before = registration.T_base_cloud();
  const double joint_motion = registration.move_to(configuration);
  const Eigen::Isometry3d T_after = registration.T_base_cloud();
  ++nr_iterations_;
  previous_transformation_ = transformation_;
  transformation_ = (T_after * T_before.inverse()).matrix().template cast<Scalar>();
  final_transformation_ = T_after.matrix().template cast<Scalar>();
  if (!pair_up()) {
    return false;
  }
  if (this->update_visualizer_) {
    show();
  }
  Criteria& criteria = *state_->criteria;
  if (!is_narrow && nr_iterations_ < this->max_iterations_) {
    return true;  // whatever rests within wide gates may still move within narrow ones
  }
  const bool is_done = criteria.hasConverged();
  if (criteria.getConvergenceState() == ConvergenceCriteria::CONVERGENCE_CRITERIA_TRANSFORM &&
      joint_motion * joint_motion > this->transformation_epsilon_) {
    return true;  // PCL's criterion sees the base alone
  }
  converged_ = is_done;
  return !is_done;
}

template <typename PointT, typename Scalar>
bool ArticulatedSdfRegistration<PointT, Scalar>::pair_up() {
  correspondences_->clear();
  for (const ScanRegistration::Pair& pair : state_->registration.pairs(reach())) {
    correspondences_->emplace_back(static_cast<pcl::index_t>(pair.point),
                                   static_cast<pcl::index_t>(pair.sample), pair.squared_distance);
  }
  if (correspondences_->size() >= this->min_number_correspondences_) {
    return true;
  }
  PCL_ERROR(
      "[lockbox::%s] Not enough points near the model; is the guess right, the maximum "
      "correspondence distance too small?\n",
      this->getClassName().c_str());
  state_->criteria->setConvergenceState(
      ConvergenceCriteria::CONVERGENCE_CRITERIA_NO_CORRESPONDENCES);
  return false;
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::show() {
  pose_target(state_->registration.joints_in_scan());
  PointCloudSource moved;
  transform(*input_, moved, final_transformation_);
  pcl::Indices points;
  pcl::Indices samples;
  for (const pcl::Correspondence& pair : *correspondences_) {
    points.push_back(pair.index_query);
    samples.push_back(pair.index_match);
  }
  this->update_visualizer_(moved, points, *target_, samples);
}

/// A new cloud, for somebody may hold the old one.
template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::pose_target(const Configuration& joints) {
  BodyPoses T_base_body;
  forward_kinematics(state_->registration.tree(), joints, T_base_body);
  const auto target = pcl::make_shared<PointCloudTarget>();
  target->reserve(state_->registration.samples().all().size());
  for (const ModelSample& sample : state_->registration.samples().all()) {
    target->push_back(to_point<PointT>(sample, T_base_body[sample.body]));
  }
  target_ = target;
  if (!tree_) {
    restore_search_tree();
  }
  tree_->setInputCloud(target_);
  this->target_cloud_updated_ = false;
}

/// PCL's maximum correspondence distance; nobody sets its default, the root of the largest number.
template <typename PointT, typename Scalar>
double ArticulatedSdfRegistration<PointT, Scalar>::reach() const {
  const double distance = this->corr_dist_threshold_;
  const bool is_set = distance >= 0.0 && distance < std::sqrt(std::numeric_limits<double>::max());
  return is_set ? std::min(distance, kWidestReach) : kUsualReach;
}

}  // namespace lockbox
