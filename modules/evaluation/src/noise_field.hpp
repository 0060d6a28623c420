// SPDX-License-Identifier: BSD-3-Clause
// Disparity noise that neighbouring pixels have in common, as an unknown beside the others.
//
// Noise with the correlation exp(-r^2 / (2 L^2)) is white noise blurred by a Gaussian of width
// w = L / sqrt(2). White noise on a grid of nodes little more than L apart is enough, since the
// blur leaves little of what is finer: n = B c, c_k ~ N(0, s^2). Marginalising over c,
//
//   G' (W^-1 + s^2 B B')^-1 G = G' W G - (B' W G)' (1/s^2 + B' W B)^-1 (B' W G)
//
// with W the inverse variances of what else a pixel errs. The matrix in the middle couples each
// node to its neighbours only, and is solved by conjugate gradients.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/simulation/sensor_model.hpp"

namespace lockbox {

/// A row-major image with `channels` numbers a pixel.
struct ChannelImage {
  int width = 0;
  int height = 0;
  std::size_t channels = 1;
  std::vector<double> values;

  void resize(int new_width, int new_height, std::size_t new_channels) {
    width = new_width;
    height = new_height;
    channels = new_channels;
    values.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels,
                  0.0);
  }
  double* at(int u, int v) { return &values[index(u, v)]; }
  const double* at(int u, int v) const { return &values[index(u, v)]; }

 private:
  std::size_t index(int u, int v) const {
    return (static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(u)) *
           channels;
  }
};

/// Reusable buffers; not thread-safe.
class NoiseField {
 public:
  /// The sensor's noise must be correlated.
  NoiseField(const SensorModel& sensor, const PinholeCamera& camera, const Executor& executor);

  /// What the field takes away from the information: the second term above, without its sign.
  /// weights: W by pixel; weighted: W G by pixel, one channel an unknown.
  Eigen::MatrixXd lost_information(const ChannelImage& weights, const ChannelImage& weighted);

 private:
  void assemble(const ChannelImage& weights);
  void project(const ChannelImage& weighted, ChannelImage& projected) const;
  void multiply(const ChannelImage& x, ChannelImage& product) const;
  void solve(const ChannelImage& right, ChannelImage& solution) const;

  Eigen::ArrayXd dot(const ChannelImage& a, const ChannelImage& b) const;

  Executor executor_;
  int spacing_;  ///< of the nodes, pixels
  int reach_;    ///< of the blur from a node, pixels
  int margin_;   ///< nodes outside the image on each side
  int coupled_;  ///< how many nodes away a node is coupled to
  int nodes_u_;
  int nodes_v_;
  double precision_;          ///< 1 / s^2
  std::vector<double> taps_;  ///< of the blur along one axis
  /// B' W B: by node, its coupling to the (2 coupled + 1)^2 nodes around it.
  std::vector<float> coupling_;
};

}  // namespace lockbox
