// SPDX-License-Identifier: BSD-3-Clause
// How large the object looks beside its model: whether contours, which tell how large it is in the
// image, and faces, which tell how far away it is and how high its relief, agree
// (docs/mathematics-uncertainty.md, "Does the size fit?").
#pragma once

#include <Eigen/Cholesky>
#include <span>
#include <vector>

#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/terms/observed_contour.hpp"
#include "lockbox/terms/size_system.hpp"
#include "lockbox/view/predicted_view.hpp"
#include "steps.hpp"

namespace lockbox {

/// Reuses its buffers. What is estimated stays as it is.
class SizeMeter {
 public:
  /// Model and steps must outlive it.
  SizeMeter(const ArticulatedModel& model, const RegistrationOptions& options, const Steps& steps);

  /// view: of the configuration, in the cloud, which has an image.
  SizeMeasurement measure(const PredictedView& view, const TiledCloud& cloud,
                          const Configuration& configuration);

 private:
  /// Of the model, body frame.
  struct FacePoint {
    int body;
    Eigen::Vector3d point;
    Eigen::Vector3d normal;
  };
  void choose_faces(const PredictedView& view);
  void add_faces(const TiledCloud& cloud, double annealing_sigma);
  void add_contours(const PredictedView& view, const TiledCloud& cloud, double annealing_sigma);
  void add_contours_of_body(std::span<const ContourPoint> own, const TiledCloud& cloud,
                            double annealing_sigma);
  void take_step();
  Eigen::Matrix<double, Eigen::Dynamic, 2> effect();
  Eigen::Vector3d motion(int body, const Eigen::Vector3d& point) const;
  double weight(double residual, double variance) const;

  const ArticulatedModel& model_;
  RegistrationOptions options_;
  const Steps& steps_;

  BodyPoses poses_;  ///< of the configuration, as all that follows
  std::vector<BodyJacobian> jacobians_;
  Eigen::Vector3d base_;   ///< its origin, camera's frame
  double side_off_ = 0.0;  ///< metres that whole sides are off
  double extent_ = 0.0;    ///< metres, of what is visible
  std::vector<FacePoint> face_points_;
  SizeSystem faces_;
  SizeSystem contours_;
  ObservedContour observed_;
  std::vector<ContourPoint> moved_;
  // Of (base twist, joint variables, across, along, growth).
  Eigen::VectorXd step_;
  Eigen::MatrixXd hessian_;
  Eigen::VectorXd gradient_;
  Eigen::LDLT<Eigen::MatrixXd> factors_{Eigen::MatrixXd(0, 0)};
};

}  // namespace lockbox
