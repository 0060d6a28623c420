// SPDX-License-Identifier: BSD-3-Clause
// The members of ArticulatedSdfRegistration, for the sources that instantiate them: one for each
// scalar, because the compiler needs about a gigabyte for all of them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "articulated_sdf_alignment.hpp"
#include "lockbox/pcl/articulated_sdf_registration.hpp"

namespace lockbox {

template <typename PointT, typename Scalar>
ArticulatedSdfRegistration<PointT, Scalar>::ArticulatedSdfRegistration()
    : state_(std::make_unique<State>()) {
  this->reg_name_ = "ArticulatedSdfRegistration";
  // PCL's own functions, which cannot be overridden, look into both without asking.
  input_ = pcl::make_shared<PointCloudSource>();
  target_ = pcl::make_shared<PointCloudTarget>();
  tree_ = state_->tree = pcl::make_shared<LazyTree<PointT>>();
  state_->representation = tree_->getPointRepresentation();
  state_->reciprocal_tree = this->tree_reciprocal_;
  state_->criteria = pcl::make_shared<Criteria>(nr_iterations_, transformation_, *correspondences_);
}

template <typename PointT, typename Scalar>
ArticulatedSdfRegistration<PointT, Scalar>::~ArticulatedSdfRegistration() = default;

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setModel(
    std::shared_ptr<const ArticulatedModel> model, double target_spacing) {
  state_->registration.set_model(std::move(model), target_spacing);
  pose_target(state_->registration.joints());
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setModel(ArticulatedModel model,
                                                          double target_spacing) {
  setModel(std::make_shared<const ArticulatedModel>(std::move(model)), target_spacing);
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setOptions(const RegistrationOptions& options) {
  state_->registration.set_options(options);
}

template <typename PointT, typename Scalar>
const RegistrationOptions& ArticulatedSdfRegistration<PointT, Scalar>::getOptions() const {
  return state_->registration.options();
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setCamera(
    const std::optional<PinholeCamera>& camera) {
  state_->registration.set_camera(camera);
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setNumberOfThreads(unsigned int threads) {
  state_->registration.set_threads(static_cast<int>(threads));
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setJointPositions(
    const Eigen::VectorXd& positions) {
  state_->registration.set_joints(positions);
  pose_target(state_->registration.joints());
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setJointPosition(const std::string& joint,
                                                                  double position) {
  const KinematicTree& tree = state_->registration.tree();
  Configuration configuration = state_->registration.joints();
  set_joint_position(tree, configuration, joint, position);
  setJointPositions(configuration.q);
}

template <typename PointT, typename Scalar>
const Eigen::VectorXd& ArticulatedSdfRegistration<PointT, Scalar>::getJointPositions() const {
  return state_->registration.joints().q;
}

template <typename PointT, typename Scalar>
double ArticulatedSdfRegistration<PointT, Scalar>::getJointPosition(
    const std::string& joint) const {
  const KinematicTree& tree = state_->registration.tree();
  return joint_position(tree, state_->registration.joints(), joint_index(tree, joint));
}

template <typename PointT, typename Scalar>
const Eigen::MatrixXd& ArticulatedSdfRegistration<PointT, Scalar>::getCovariance() const {
  return state_->registration.result().covariance;
}

template <typename PointT, typename Scalar>
const Eigen::VectorXd& ArticulatedSdfRegistration<PointT, Scalar>::getStandardDeviations() const {
  return state_->registration.result().sigma;
}

template <typename PointT, typename Scalar>
const std::vector<bool>& ArticulatedSdfRegistration<PointT, Scalar>::getObservable() const {
  return state_->registration.result().observable;
}

template <typename PointT, typename Scalar>
const Agreement& ArticulatedSdfRegistration<PointT, Scalar>::getAgreement() const {
  return state_->registration.result().agreement;
}

template <typename PointT, typename Scalar>
typename ArticulatedSdfRegistration<PointT, Scalar>::ConvergenceCriteria::Ptr
ArticulatedSdfRegistration<PointT, Scalar>::getConvergeCriteria() const {
  return state_->criteria;
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setInputSource(
    const PointCloudSourceConstPtr& cloud) {
  if (!tree_) {
    restore_search_tree();
  }
  if (cloud && !cloud->empty()) {
    Base::setInputSource(cloud);
    return;
  }
  PCL_ERROR("[lockbox::%s::setInputSource] The cloud is empty.\n", this->getClassName().c_str());
  input_ = cloud ? cloud : pcl::make_shared<PointCloudSource>();
  state_->selection.reset();
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setIndices(const pcl::IndicesPtr& indices) {
  state_->selection = indices;
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setIndices(const pcl::IndicesConstPtr& indices) {
  state_->selection = indices ? pcl::make_shared<pcl::Indices>(*indices) : nullptr;
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setIndices(const PointIndicesConstPtr& indices) {
  state_->selection = indices ? pcl::make_shared<pcl::Indices>(indices->indices) : nullptr;
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setIndices(std::size_t first_row,
                                                            std::size_t first_column,
                                                            std::size_t rows, std::size_t columns) {
  this->indices_.reset();
  Base::setIndices(first_row, first_column, rows, columns);
  if (this->indices_) {
    state_->selection = std::move(this->indices_);
  }
  this->indices_.reset();
}

template <typename PointT, typename Scalar>
pcl::IndicesPtr ArticulatedSdfRegistration<PointT, Scalar>::getIndices() const {
  return state_->selection;
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setInputTarget(
    const PointCloudTargetConstPtr& cloud) {
  if (state_->registration.has_model()) {
    warn_once("setInputTarget (the target is the model)");
  } else if (cloud) {
    Base::setInputTarget(cloud);
  }
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::refuse_null_tree(const char* function) const {
  PCL_ERROR("[lockbox::%s::%s] The search tree is null; the one before is kept.\n",
            this->getClassName().c_str(), function);
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setSearchMethodTarget(const KdTreePtr& tree,
                                                                       bool force_no_recompute) {
  if (!tree) {
    refuse_null_tree("setSearchMethodTarget");
    return;
  }
  Base::setSearchMethodTarget(tree, force_no_recompute);
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setSearchMethodSource(
    const KdTreeReciprocalPtr& tree, bool force_no_recompute) {
  if (!tree) {
    refuse_null_tree("setSearchMethodSource");
    return;
  }
  Base::setSearchMethodSource(tree, force_no_recompute);
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setUseReciprocalCorrespondences(bool /*use*/) {
  warn_once("setUseReciprocalCorrespondences");
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setUseSymmetricObjective(bool /*use*/) {
  warn_once("setUseSymmetricObjective");
}

template <typename PointT, typename Scalar>
void ArticulatedSdfRegistration<PointT, Scalar>::setEnforceSameDirectionNormals(bool /*enforce*/) {
  warn_once("setEnforceSameDirectionNormals");
}

}  // namespace lockbox
