// SPDX-License-Identifier: BSD-3-Clause
// How well positions of one joint explain the part of the depth image that they change, by all that
// the noise of the sensor lets it tell: steps between neighbouring pixels count, whose errors go
// together, and heights as far as they are not lost in the noise.
//
// In inverse depth, which a sensor that measures disparities errs alike in everywhere. A pixel is
// expected to measure the mean over its lateral jitter, from a rendering of three by three samples
// a pixel. chi^2 = r' C^-1 r with r the measured less the expected image (noise_covariance.hpp).
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/model/configuration.hpp"
#include "lockbox/registration/noise_covariance.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox {

/// Draws on one thread; reuses its buffers. The tree is referred to.
class PatchLikelihood {
 public:
  /// cut: pixels that err by more standard deviations at all positions show something else.
  PatchLikelihood(const KinematicTree& tree, const SensorNoise& noise, double cut);

  /// Draws the model with a variable at each of the positions. With `believed`, pixels weigh less
  /// near the outlines of that position, where they may show either side: right around it, but no
  /// measure for comparing it with others, which would have to pay for theirs. False where there is
  /// nothing to compare, or too much.
  bool draw(const TiledCloud& cloud, const Configuration& configuration, int variable,
            std::span<const double> positions, std::optional<std::size_t> believed = {});

  /// Pixels that are compared.
  int pixels() const { return compared_; }

  /// Of the position with this number.
  double chi_squared(std::size_t position);

  /// One step of Newton's method.
  struct Step {
    double change;       ///< of the variable, its unit
    double information;  ///< 1 / variance of the result
  };
  /// At a position, with the derivative from one on each side of it.
  Step step(std::size_t below, std::size_t at, std::size_t above);

 private:
  struct Frame {
    int left, top, width, height;  ///< pixels
    std::size_t pixels() const {
      return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    std::size_t index(int u, int v) const {
      return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
             static_cast<std::size_t>(u);
    }
  };

  bool frame_motion(const PinholeCamera& camera, const Configuration& configuration, int variable);
  void render(const Configuration& configuration, const std::vector<std::uint8_t>& moved,
              bool of_moved, RenderedDepth& image);
  void merge_with_rest();
  void blur(std::span<float> means, bool with_variances);
  void add_own_variances();
  void leave_out_what_shows_nothing();
  void read_measured(const TiledCloud& cloud);
  void compare();
  std::span<float> means(std::size_t position) {
    return {&means_[position * frame_.pixels()], frame_.pixels()};
  }

  const KinematicTree& tree_;
  SensorNoise noise_;
  double cut_;
  NoiseCovariance covariance_;
  std::vector<Eigen::AlignedBox3d> boxes_;        ///< by body
  std::vector<std::vector<std::uint8_t>> moved_;  ///< by variable, then by body
  std::unique_ptr<DepthRenderer> renderer_;

  std::vector<double> positions_;
  Frame frame_{};
  int compared_ = 0;
  std::vector<Eigen::Isometry3d> poses_;
  std::vector<RenderItem> items_;
  Configuration trial_;
  RenderedDepth rest_;
  RenderedDepth moving_;
  std::vector<float> samples_;  ///< inverse depths, 1/metre; 0: nothing
  std::vector<float> column_sums_;
  std::vector<float> column_squares_;
  std::vector<float> measured_;   ///< inverse depth by pixel; 0: nothing
  std::vector<float> means_;      ///< by position, then by pixel
  std::vector<float> variances_;  ///< of each pixel's own error
  std::vector<float> weights_;
  std::vector<float> residuals_;
  std::vector<std::uint8_t> has_ground_;  ///< by pixel: whether it shows what rests, or would
};

}  // namespace lockbox
