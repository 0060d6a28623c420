// SPDX-License-Identifier: BSD-3-Clause
// What was measured, in cells of inverse depth, in which planes are linear; and how likely a cell
// is in a scene of surfaces that go on.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "lockbox/sensor/sensor_noise.hpp"
#include "lockbox/verification/coarse_view.hpp"
#include "lockbox/verification/evidence_options.hpp"

namespace lockbox {

/// Two cells in a row, at distances near and far, from which a plane through both foretells a
/// third. They are too far to share its contour.
struct Sight {
  int du;
  int dv;
  int near;
  int far;

  /// A unit vector from the third cell to these.
  Eigen::Vector2f way() const {
    return Eigen::Vector2f(static_cast<float>(du), static_cast<float>(dv)).normalized();
  }
  constexpr double ratio() const { return static_cast<double>(near) / (far - near); }
  /// Of the third cell's inverse depth.
  constexpr double foretold(double at_near, double at_far) const {
    return at_near + ratio() * (at_near - at_far);
  }
  /// Of a foretold value and of the cell's own, in variances of a cell.
  constexpr double variances() const {
    return (1.0 + ratio()) * (1.0 + ratio()) + ratio() * ratio();
  }
};

/// The eight directions; cells along diagonals are 1.4 times as far apart. Unit: cells. Source: not
/// recorded. Doubled, planes are foretold over surfaces that bend.
inline constexpr std::array<Sight, 8> kSights{{{1, 0, 3, 5},
                                               {-1, 0, 3, 5},
                                               {0, 1, 3, 5},
                                               {0, -1, 3, 5},
                                               {1, 1, 2, 4},
                                               {-1, -1, 2, 4},
                                               {1, -1, 2, 4},
                                               {-1, 1, 2, 4}}};

class SceneCells {
 public:
  /// sensor: of a pixel. What cells err by beside those around them, as a share of that, is
  /// measured in the frame itself.
  /// tolerance: what a model differs by from its object along the ray, standard deviation, metres.
  SceneCells(const CoarseView& view, const SensorNoise& sensor, double tolerance,
             const EvidenceOptions& options);

  const EvidenceOptions& options() const { return options_; }

  const PinholeCamera& camera() const { return camera_; }
  int width() const { return camera_.width; }
  int height() const { return camera_.height; }
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width) +
           static_cast<std::size_t>(u);
  }
  bool contains(int u, int v) const {
    return u >= 0 && v >= 0 && u < camera_.width && v < camera_.height;
  }
  /// 1/metre; 0 where nothing was measured.
  double at(int u, int v) const { return static_cast<double>(cells_[index(u, v)]); }

  std::span<const float> cells() const { return cells_; }

  /// The standard deviation of a cell's noise beside that of those around it, at an inverse depth:
  /// 1/metre.
  double noise(double inverse_depth) const { return share_ * sensor_.sigma_inverse(inverse_depth); }
  /// Of a pixel, and the share of it that noise() is: for loops over rows, which take its
  /// coefficients (SensorNoise::sigma_inverse).
  const SensorNoise& sensor() const { return sensor_; }
  double share() const { return share_; }
  double tolerance() const { return tolerance_; }
  /// Returns the deviation from what a model shows there: all of the cell's noise and the model's
  /// tolerance.
  double deviation(double inverse_depth) const;
  /// Returns the deviation from what is foretold from two other cells.
  double deviation(double inverse_depth, const Sight& sight) const;

  /// Cells by which a contour may be off, all told.
  int contour_reach(double inverse_depth) const;

  /// The density of the cell's measurement, if nothing is known but its surroundings: surfaces go
  /// on from there, or something else begins, anywhere.
  double density(int u, int v) const;

 private:
  EvidenceOptions options_;
  PinholeCamera camera_;
  std::vector<float> cells_;
  SensorNoise sensor_;
  double share_;  ///< of a pixel's noise, what a cell errs by beside those around it
  double tolerance_;
};

/// Returns the density of a normal distribution so far from its mean.
double normal_density(double distance, double deviation);

}  // namespace lockbox
