// SPDX-License-Identifier: BSD-3-Clause
// Joints whose parts stand out by less than the noise of a depth: a slider of 12 mm, seen from 2 m.
// Points on it might as well lie beside it, and pull it wherever the noise goes; its contour is no
// jump. What tells where it is are small steps between neighbouring pixels, whose errors go
// together (region_likelihood.hpp).
#pragma once

#include <optional>
#include <span>

#include "lockbox/model/articulated_model.hpp"
#include "lockbox/sensor/sensor_noise.hpp"
#include "lockbox/terms/region_likelihood.hpp"
#include "lockbox/view/view_options.hpp"

namespace lockbox {

/// Where the image shows what a joint moves, given everything else.
struct JointMatch {
  double position;  ///< radians or metres
  double variance;
};

/// What the image says of a joint's whole range.
struct RangeMatch {
  /// Nothing where no position is better than that of the configuration by more than noise is.
  std::optional<JointMatch> better;
  /// Whether positions that are elsewhere are worse by as much as they are where the part is there.
  bool is_told = true;
};

/// Reuses its buffers. The same for any number of threads. The model must outlive it.
class LowProminence {
 public:
  /// Prominence (standard deviations of a depth) from which on points alone tell where the part is.
  /// Source: not recorded. Doubled, more joints are matched by the image, which takes longer.
  static constexpr double kSurelyStandsOut = 4.0;

  LowProminence(const ArticulatedModel& model, const ViewOptions& options,
                const Executor& executor);

  /// How far what a joint variable moves stands out where it is, standard deviations of a depth.
  double prominence(int variable, const Configuration& configuration);

  /// How far the variable moves when surfaces move by a pixel.
  double pixel_step(const PinholeCamera& camera, const Configuration& configuration, int variable);

  /// Sought a few pixels around the configuration and on the way to where it was before points
  /// pulled it. Nothing where the image does not tell; nor where what hardly stands out is not
  /// there.
  std::optional<JointMatch> find_near(const TiledCloud& cloud, const Configuration& configuration,
                                      int variable, double before);

  RangeMatch find_anywhere(const TiledCloud& cloud, const Configuration& configuration,
                           int variable);

 private:
  bool is_there(const TiledCloud& cloud, const Configuration& configuration, int variable,
                double position);
  double distance(int variable, const Configuration& configuration);
  double scatter_around(std::size_t least) const;
  JointMatch match_at(std::size_t least) const;

  const ArticulatedModel& model_;
  SensorNoise noise_;
  Eigen::VectorXd prominences_;    ///< by variable, metres
  Eigen::VectorXd motion_scales_;  ///< by variable, metres that surfaces move for a unit
  RegionLikelihood region_;
  std::vector<Eigen::Isometry3d> poses_;
  std::vector<double> positions_;
  std::span<const double> costs_;  ///< chi^2 by position
};

}  // namespace lockbox
