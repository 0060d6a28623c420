// SPDX-License-Identifier: BSD-3-Clause
// How residuals change with the size of the model, beside how they change with the motion of its
// bodies (docs/mathematics-uncertainty.md, "Does the size fit?").
//
// A model that grows about the origin o of its base moves its point c (camera's frame) by
//
//   (across (c - o)_x, across (c - o)_y, along (c - o)_z).
//
// across = along is a larger object, or depths that are measured too long; across alone is a focal
// length that is given too small. A contour is seen `growth` pixels too far out beside that: a
// sensor whose foreground grows.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <tuple>
#include <vector>

#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {

inline constexpr int kSizeUnknowns = 3;  ///< across, along, growth

/// (twist of the body, across, along, growth).
using SizeRow = Eigen::Matrix<double, 6 + kSizeUnknowns, 1>;

/// Returns the row of a residual that changes by direction . motion as the model's point moves.
/// base: the origin of the model's base. All in the camera's frame, metres. pixel: metres that a
/// pixel of growth adds to the residual; 0 for what is no contour.
SizeRow size_row(const Eigen::Isometry3d& T_camera_body, const Eigen::Vector3d& base,
                 const Eigen::Vector3d& point, const Eigen::Vector3d& direction, double pixel);

/// Where a size moves a point to, from `point`, metres.
Eigen::Vector3d size_motion(const Eigen::Vector3d& base, const Eigen::Vector3d& point,
                            double across, double along);

/// Normal equations of a step (base twist, joint variables, across, along, growth). Nobody builds
/// exactly what was drawn, and errors of sensors go together along an edge, so that each side is
/// off as a whole, by an unknown of its own, which is eliminated: a side tells as one witness.
class SizeSystem {
 public:
  /// What is off as a whole: of a body, surface (or contour) with that direction, at that place
  /// along it.
  struct Side {
    int body;
    bool is_contour;
    Eigen::Vector3d direction;  ///< body frame
    double offset;              ///< metres along it
  };

  void set_zero(std::size_t bodies);
  void add(const Side& side, const SizeRow& row, double residual, double weight);

  /// Adds to the equations of a step, jacobians being those of the bodies. off: metres that sides
  /// are off, standard deviation.
  void add_to(const std::vector<BodyJacobian>& jacobians, double off, Eigen::MatrixXd& hessian,
              Eigen::VectorXd& gradient) const;

 private:
  using Key = std::tuple<int, bool, int, int>;
  /// Sums of weights, of rows and of residuals.
  struct Sums {
    double weight = 0.0;
    SizeRow row = SizeRow::Zero();
    double residual = 0.0;
  };
  using SizeMatrix = Eigen::Matrix<double, 6 + kSizeUnknowns, 6 + kSizeUnknowns>;
  struct OfBody {
    SizeMatrix hessian = SizeMatrix::Zero();
    SizeRow gradient = SizeRow::Zero();
  };

  std::vector<OfBody> bodies_;
  std::map<Key, Sums> sides_;
};

}  // namespace lockbox
