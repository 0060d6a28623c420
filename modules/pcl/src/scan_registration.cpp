// SPDX-License-Identifier: BSD-3-Clause
#include "scan_registration.hpp"

#include "lockbox/cloud/image_points.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/solver/motion_metric.hpp"
#include "surface_pairs.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kTargetPoints = 30000;
constexpr std::size_t kMaxPairs = 1000;

}  // namespace

void ScanRegistration::set_model(std::shared_ptr<const ArticulatedModel> model, double spacing) {
  if (!model) {
    throw InputError("ArticulatedSdfRegistration", "setModel was given no model");
  }
  ModelSamples samples(*model, spacing > 0.0 ? spacing : sample_spacing(*model, kTargetPoints));
  registration_ = std::make_unique<ArticulatedRegistration>(*model, options_, executor_);
  samples_ = std::move(samples);
  model_ = std::move(model);
  joints_ = {Eigen::Isometry3d::Identity(), rest_configuration(model_->tree).q};
  result_ = {};
}

void ScanRegistration::set_options(const RegistrationOptions& options) {
  if (model_) {
    registration_ = std::make_unique<ArticulatedRegistration>(*model_, options, executor_);
  }
  options_ = options;
}

void ScanRegistration::set_threads(int threads) {
  executor_ = Executor(threads);
  set_options(options_);
}

void ScanRegistration::set_joints(const Eigen::VectorXd& q) {
  const int variables = tree().variables();
  if (q.size() != variables || !q.allFinite()) {
    throw InputError("joint positions", "the model needs " + std::to_string(variables) +
                                            " finite values, one a joint that mimics no other");
  }
  joints_.q = q;
}

const KinematicTree& ScanRegistration::tree() const {
  if (!model_) {
    throw InputError("ArticulatedSdfRegistration", "it has no model yet; call setModel first");
  }
  return model_->tree;
}

bool ScanRegistration::begin(const Scan& scan, const Eigen::Isometry3d& T_base_cloud) {
  const Eigen::Isometry3d T_cloud_base = T_base_cloud.inverse();
  const auto T_image_cloud = tile_image(scan, camera_, executor_, cloud_);
  T_camera_cloud_ = T_image_cloud ? *T_image_cloud
                                  : tile_points(scan, camera_, T_cloud_base.translation(), cloud_);
  placed_ = {T_camera_cloud_ * T_cloud_base, joints_.q};
  return T_image_cloud.has_value();
}

bool ScanRegistration::align(const AlignOptions& align_options) {
  registration_->align(cloud_, placed_, align_options, found_);
  return found_.converged;
}

void ScanRegistration::accept() {
  result_ = found_;
  placed_ = result_.configuration;
  joints_.q = placed_.q;
}

double ScanRegistration::move_to(const Configuration& configuration) {
  const Configuration base_moved{configuration.T_camera_base, placed_.q};
  placed_ = configuration;
  return registration_->moves().between(base_moved, configuration);
}

Eigen::Isometry3d ScanRegistration::T_base_cloud() const {
  return placed_.T_camera_base.inverse() * T_camera_cloud_;
}

std::vector<ScanRegistration::Pair> ScanRegistration::pairs(double reach) const {
  BodyPoses poses;
  forward_kinematics(model_->tree, placed_, poses);
  ImagePoints of_image;
  if (cloud_.has_image()) of_image.assign(cloud_, executor_);
  const PointTiles& points = cloud_.has_image() ? of_image : cloud_.blocks();
  std::vector<Pair> pairs;
  for (const SurfacePair& pair : surface_pairs(*model_, poses, points, reach, kMaxPairs)) {
    pairs.push_back({pair.point, samples_->nearest(pair.body, pair.p_body), pair.squared_distance});
  }
  return pairs;
}

}  // namespace lockbox
