// SPDX-License-Identifier: BSD-3-Clause
// How well positions of one joint explain the part of the depth image that they change, by all that
// the noise of the sensor lets it tell: steps between neighbouring pixels count, whose errors go
// together, and heights as far as they are not lost in the noise.
//
// In inverse depth, which a sensor that measures disparities errs alike in everywhere. A pixel is
// expected to measure the mean over its lateral jitter, from a rendering of three by three samples
// a pixel. chi^2 = r' C^-1 r with r the measured less the expected image (patch_noise.hpp).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/configuration.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/sensor/sensor_noise.hpp"

namespace lockbox {

/// Reuses its buffers. The same for any number of threads. The tree is referred to.
class RegionLikelihood {
 public:
  /// gate: pixels that err by more standard deviations at all positions show something else.
  RegionLikelihood(const KinematicTree& tree, const SensorNoise& noise, double gate,
                   const Executor& executor);
  ~RegionLikelihood();
  RegionLikelihood(RegionLikelihood&&) noexcept;

  /// chi^2 with a variable at each of the positions; nothing where there is nothing to compare, or
  /// too much. Valid until the next call.
  std::span<const double> compare(const TiledCloud& cloud, const Configuration& configuration,
                                  int variable, std::span<const double> positions);

  /// Returns by how much chi^2 rises in the mean from the last position to each, where the last is
  /// right.
  std::span<const double> expected_rises() const { return rises_; }

  /// Pixels that were compared: those around which some position changes anything.
  int pixels() const { return compared_; }

 private:
  /// Whole patches; at its right and below it may reach beyond the image.
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

  struct Worker;
  Worker& worker() const { return *workers_[Executor::worker()]; }

  void draw(const PinholeCamera& camera, const Configuration& configuration, int variable);
  bool frame_motion(const PinholeCamera& camera, const Configuration& configuration, int variable);
  void blur(Worker& worker, std::span<float> means) const;
  void measure_edges_at_rest(Worker& worker);
  void leave_out_what_shows_nothing();
  void read_measured(const TiledCloud& cloud);
  float least_residual(std::size_t pixel) const;
  bool differs_in_patch(int left, int top) const;
  void compare_patch(std::size_t patch);
  void sum_up();
  std::span<float> means(std::size_t position) {
    return {&means_[position * frame_.pixels()], frame_.pixels()};
  }
  std::span<const float> means(std::size_t position) const {
    return {&means_[position * frame_.pixels()], frame_.pixels()};
  }

  const KinematicTree& tree_;
  double lateral_pixels_;
  double gate_;
  Executor executor_;
  std::vector<Eigen::AlignedBox3d> boxes_;        ///< by body
  std::vector<std::vector<std::uint8_t>> moved_;  ///< by variable, then by body
  std::vector<std::unique_ptr<Worker>> workers_;  ///< by thread

  std::vector<double> positions_;
  Frame frame_{};
  int compared_ = 0;
  Configuration trial_;
  std::vector<Eigen::Isometry3d> poses_;
  RenderedDepth rest_;
  std::vector<float> edge_variances_;     ///< by pixel
  std::vector<float> measured_;           ///< inverse depth by pixel; 0: nothing
  std::vector<float> means_;              ///< by position, then by pixel
  std::vector<std::uint8_t> has_ground_;  ///< by pixel: whether it shows what rests, or would
  std::vector<int> pixels_of_patch_;      ///< that were compared
  std::vector<double> sums_of_patch_;     ///< of their squares: by patch, then by position
  std::vector<double> rises_of_patch_;    ///< likewise, of the last position's less theirs
  std::vector<double> chi_squared_;       ///< by position
  std::vector<double> rises_;             ///< by position
};

}  // namespace lockbox
