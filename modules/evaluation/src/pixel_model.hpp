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

/// A pixel's measured disparity: its mean and scatter, and the mean's derivative by body twists.
struct PixelModel {
  double measured = 0.0;  ///< chance that the pixel measures anything
  double mean = 0.0;      ///< of the disparity, pixels
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
  PixelModeler(const SampledView& view, const PinholeCamera& camera, const SensorModel& sensor,
               int bodies);

  /// Fills the model of pixel (u, v). Its memory is reused.
  void model(int u, int v, PixelModel& pixel) const;

 private:
  struct Blur;

  void model_smooth(int u, int v, PixelModel& pixel) const;
  void model_broken(int u, int v, PixelModel& pixel) const;
  bool moves(int id) const { return id >= 0 && id < bodies_; }
  void add_sample(PixelModel& pixel, Blur& blur, int u, int v, std::size_t column,
                  std::size_t row) const;
  static void add(PixelModel& pixel, int body, const Twist& derivative);
  void add_step(PixelModel& pixel, int u, int v, int next_u, int next_v, double weight) const;
  double independent_variance(double disparity) const;

  const SampledView& view_;
  PinholeCamera camera_;
  SensorModel sensor_;
  int bodies_;
  double jitter_variance_;
  std::vector<double> weights_;          ///< of samples -reach .. reach, normalised
  std::vector<double> between_weights_;  ///< of the points half a sample after them
};

}  // namespace lockbox
