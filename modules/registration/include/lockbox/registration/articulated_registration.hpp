// SPDX-License-Identifier: BSD-3-Clause
// One registration step: cloud and starting configuration in, best configuration out.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "lockbox/model/configuration.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/verification/agreement.hpp"

namespace lockbox {

struct ArticulatedModel;
class CollisionTerm;
class Executor;
class MotionMetric;
class TiledCloud;

/// Gates begin with the annealing sigma and end with the sensor's noise alone.
struct AlignOptions {
  double annealing_sigma = 0.0;  ///< metres: how far surfaces may be from where the start puts them
  int iterations = 3;            ///< linearisations, at most
  bool hold_joints = false;      ///< move the base only
  int narrowing = 0;  ///< linearisations until the annealing sigma is gone; 0: all of them
  /// The start is a prediction. Of flat faces, points are averaged (block_averages.hpp); of many
  /// points a few are enough for all iterations but the last, which follows as soon as steps are
  /// short. If its own is not, it may take twice as many linearisations again.
  bool is_predicted = false;
  /// Sees the configuration after each linearisation, and whether the gates are narrow by then; may
  /// end the alignment by returning false.
  std::function<bool(const Configuration& configuration, bool is_narrow)> on_iteration = nullptr;
  bool at_edges = true;  ///< end with the step by the image at edges, if the options ask for it
  /// The cloud is that of the last alignment: what was drawn for it, and what was sought then of
  /// free space, is as good as within one alignment while surfaces are nearly where they were.
  bool goes_on = false;
};

/// How large the object looks in one image, as a multiple of its model: across the optical axis, at
/// the distance that is measured, and along it (its relief).
struct SizeMeasurement {
  Eigen::Vector2d value = Eigen::Vector2d::Ones();           ///< (across, along)
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of it
  /// How far off each of (base twist, variables) is of an alignment, which takes the size for 1: a
  /// row for a size of (1, 0) and (0, 1) more, in the unknowns' units.
  Eigen::Matrix<double, Eigen::Dynamic, 2> effect;
};

/// What an alignment has found, and how sure it is of it.
struct RegistrationResult {
  Configuration configuration;  ///< the estimate
  /// Before the last step, in which contours weigh more (docs/mathematics.md): where to begin the
  /// next time.
  Configuration at_rest;
  Eigen::MatrixXd covariance;      ///< of (base twist, variables); twist in the base's frame
  Eigen::VectorXd sigma;           ///< standard deviations, square roots of its diagonal
  Eigen::VectorXd sigma_of_noise;  ///< the same, were the object exactly its model
  std::vector<bool> observable;    ///< by unknown: whether the data determines it
  /// Radians, of the way the base is turned, were the object exactly its model; but for turns about
  /// its round axes, after which it looks the same.
  double base_turning_sigma = 0.0;
  Agreement agreement;                    ///< of the whole model with the image
  std::vector<Agreement> body_agreement;  ///< by body
  ContourAgreement contour;               ///< what the image shows beyond the contour
  /// By body: whether it is flush with what is around it, so that its edges tell little or nothing
  /// (continued_edges.hpp). Empty for clouds without an image.
  std::vector<bool> flush_bodies;
  double residual_rms = 0.0;      ///< whitened: 1 where the sensor errs as assumed
  double explained_points = 0.0;  ///< pixels, where points are means of such
  double model_cost = 0.0;        ///< relative to explaining nothing
  double free_cost = 0.0;         ///< of free space, weighted by lambda_free
  double collision_cost = 0.0;    ///< of penetration, weighted by lambda_collision
  int iterations = 0;             ///< linearisations that were made
  /// Metres that the last iteration moved surfaces, at most, beyond what noise does: 0 at rest.
  double last_move = 0.0;
  bool converged = false;  ///< whether the last step was within RegistrationOptions::step_tolerance
};

/// Owns all memory of the loop: once used, it allocates nothing for images of the same size. Use
/// one per thread. The model must outlive it.
class ArticulatedRegistration {
 public:
  /// Throws InputError if the model's file asks for an erosion that a body is too thin for.
  ArticulatedRegistration(const ArticulatedModel& model, const RegistrationOptions& options,
                          const Executor& executor);
  ~ArticulatedRegistration();
  ArticulatedRegistration(ArticulatedRegistration&&) noexcept;
  ArticulatedRegistration& operator=(ArticulatedRegistration&&) noexcept;

  /// Aligns the model with the cloud, from the start on. A cloud without an image has no free-space
  /// term.
  RegistrationResult align(const TiledCloud& cloud, const Configuration& start,
                           const AlignOptions& align_options);

  /// Does the same into a result whose memory is used again.
  void align(const TiledCloud& cloud, const Configuration& start, const AlignOptions& align_options,
             RegistrationResult& result);

  /// Measures how large the object looks in the cloud, at a configuration that was found there.
  /// The cloud is that of the last alignment, unchanged since then, and what was drawn for it is
  /// used again; or it is any other one, and the model is drawn for it. A cloud without an image
  /// tells nothing: the size is 1, with a standard deviation of 1, and `effect` is empty. The
  /// next alignment finds the same as without this call.
  SizeMeasurement measure_size(const TiledCloud& cloud, const Configuration& configuration);

  /// Returns the options as they were given, with one entry of `locked` for each variable.
  const RegistrationOptions& options() const;
  /// Returns the term that keeps bodies out of each other.
  const CollisionTerm& collision() const;
  /// Returns the model that is aligned.
  const ArticulatedModel& model() const;
  /// Returns how far steps move surfaces, which makes metres of steps of all unknowns.
  const MotionMetric& moves() const;

 private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

}  // namespace lockbox
