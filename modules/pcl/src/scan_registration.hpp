// SPDX-License-Identifier: BSD-3-Clause
// What PCL's face of the registration does whatever the point type: the model, its joints, and one
// alignment at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/registration/articulated_registration.hpp"
#include "model_samples.hpp"
#include "scan.hpp"

namespace lockbox {

class ScanRegistration {
 public:
  /// A measured point and the sample of the model's surface beside it.
  struct Pair {
    std::uint32_t point;     ///< of the scan
    std::size_t sample;      ///< of samples()
    float squared_distance;  ///< of the point to the surface, m^2
  };

  /// Throw InputError if there is no model, or it cannot be registered with these options.
  void set_model(std::shared_ptr<const ArticulatedModel> model, double spacing);
  void set_options(const RegistrationOptions& options);
  void set_threads(int threads);
  void set_camera(const std::optional<PinholeCamera>& camera) { camera_ = camera; }
  void set_joints(const Eigen::VectorXd& q);

  bool has_model() const { return model_ != nullptr; }
  const KinematicTree& tree() const;
  const RegistrationOptions& options() const { return options_; }
  const RegistrationResult& result() const { return result_; }
  const ModelSamples& samples() const { return *samples_; }

  /// The joints, and the base at the origin.
  const Configuration& joints() const { return joints_; }

  /// Places the model in the scan. Returns whether the scan is an image.
  bool begin(const Scan& scan, const Eigen::Isometry3d& T_base_cloud);

  /// Aligns from there, within the scan that begin() was given.
  bool align(const AlignOptions& align_options);

  /// Takes what align() found as where the model is, the joints and the result.
  void accept();

  /// Moves the model to a configuration that align() reports. Returns how far the joints alone
  /// moved its surfaces, metres.
  double move_to(const Configuration& configuration);

  /// Where the model is in the scan.
  Eigen::Isometry3d T_base_cloud() const;
  Configuration joints_in_scan() const { return {Eigen::Isometry3d::Identity(), placed_.q}; }

  /// An even selection of the points within reach (metres) of the model where it is.
  std::vector<Pair> pairs(double reach) const;

 private:
  std::shared_ptr<const ArticulatedModel> model_;
  RegistrationOptions options_;
  Executor executor_;
  std::optional<PinholeCamera> camera_;
  std::optional<ModelSamples> samples_;
  std::unique_ptr<ArticulatedRegistration> registration_;
  Configuration joints_;
  RegistrationResult result_;

  TiledCloud cloud_;
  Eigen::Isometry3d T_camera_cloud_ = Eigen::Isometry3d::Identity();
  Configuration placed_;      ///< in the camera's frame
  RegistrationResult found_;  ///< by align(), until accept()
};

}  // namespace lockbox
