// SPDX-License-Identifier: BSD-3-Clause
// What one pixel measures, and how that depends on the motion of each body.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "lockbox/core/lie.hpp"
#include "lockbox/simulation/sensor_model.hpp"
#include "sampled_view.hpp"

namespace lockbox {

/// A pixel's measured disparity: its scatter, and the derivative of its mean by body twists.
struct PixelModel {
  double measured = 0.0;  ///< chance that the pixel measures anything
  double variance = 0.0;  ///< pixels^2, of all that is this pixel's own: not of correlated noise

  struct BodyDerivative {
    int body;
    Twist derivative;  ///< pixels by the body's twist in the camera's frame
  };
  std::vector<BodyDerivative> derivatives;  ///< of the bodies that the pixel may see
};

/// Items with ids 0 .. bodies - 1 move, all others stand still.
class PixelModeler {
 public:
  PixelModeler(const SampledView& view, const SensorModel& sensor, int bodies);

  /// Of pixel (u, v). The model's memory is reused.
  void model(int u, int v, PixelModel& pixel) const;

 private:
  struct Motion;
  struct Blur;

  void model_smooth(int u, int v, PixelModel& pixel) const;
  void model_broken(int u, int v, PixelModel& pixel) const;
  void add_sample(PixelModel& pixel, Blur& blur, int u, int v, std::size_t column,
                  std::size_t row) const;
  void add(PixelModel& pixel, int id, const Twist& derivative) const;
  void add_step(PixelModel& pixel, int u, int v, int next_u, int next_v, double weight) const;
  Twist disparity_rate(int u, int v) const;
  Motion image_motion(int u, int v) const;
  double independent_variance(double disparity) const;

  const SampledView& view_;
  const SensorModel sensor_;
  int bodies_;
  double jitter_variance_;
  std::vector<double> weights_;          ///< of samples -reach .. reach, normalised
  std::vector<double> between_weights_;  ///< of the points half a sample after them
};

}  // namespace lockbox
