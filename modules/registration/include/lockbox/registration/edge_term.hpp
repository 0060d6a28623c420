// SPDX-License-Identifier: BSD-3-Clause
// What the image tells at the model's own edges, by all that the sensor's noise lets it tell: where
// a part stands out of the board, pixels see the one or the other, more or less often; and errors
// of neighbouring pixels go together, so that small steps between them are exact.
//
// The likelihood of the measured inverse depths d, chi^2 = r' C^-1 r with r = d -
// mean(configuration) (edge_tile.hpp, tile_noise.hpp), and its derivative. Only the pixels around
// edges count, in tiles of 8 x 8 pixels: elsewhere points tell as much, and outlines before
// anything that is not of the model have an unknown side. Good for the last step: from farther than
// an edge is blurred, it leads nowhere.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/registration/normal_equations.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox {

/// Reuses its buffers. The tree is referred to.
class EdgeTerm {
 public:
  EdgeTerm(const KinematicTree& tree, const RegistrationOptions& options, const Executor& executor);
  ~EdgeTerm();
  EdgeTerm(EdgeTerm&&) noexcept;

  /// Draws the model and compares. The cloud must have an image.
  void linearize(const TiledCloud& cloud, const std::vector<Eigen::Isometry3d>& T_camera_body,
                 const std::vector<BodyJacobian>& jacobians);

  /// chi^2 / 2 as a function of a step (base twist, joint variables), at the configuration drawn.
  const Eigen::MatrixXd& information() const { return information_; }
  const Eigen::VectorXd& gradient() const { return gradient_; }

  /// Of the pixels that are compared.
  double pixels() const { return pixels_; }
  double chi_squared() const { return chi_squared_; }

 private:
  struct EdgePixels;
  struct Worker;
  /// Sums over a row of tiles. Step: base twist in the camera's frame, joint variables, and the
  /// residual as if it were one more.
  struct RowSums {
    Eigen::MatrixXd products;
    double pixels = 0.0;
  };
  /// Whole tiles and a margin around them. Pixels at its border may lie beyond the image.
  struct Crop {
    int left, top;  ///< of its first pixel in the image
    int tile_columns, tile_rows;
    int width() const;
    int height() const;
    std::size_t index(int u, int v) const {
      return static_cast<std::size_t>(v) * static_cast<std::size_t>(width()) +
             static_cast<std::size_t>(u);
    }
    Pixel pixel(int u, int v) const { return {left + u, top + v}; }
  };

  bool crop_to_model(const PinholeCamera& camera,
                     const std::vector<Eigen::Isometry3d>& T_camera_body);
  void render(const PinholeCamera& camera, const std::vector<Eigen::Isometry3d>& T_camera_body);
  void draw_samples(int first_tile, int end_tile, int top, RenderedDepth& samples) const;
  void express_in_camera(const std::vector<Eigen::Isometry3d>& T_camera_body,
                         const std::vector<BodyJacobian>& jacobians);
  void find_bends();
  void select(const TiledCloud& cloud, int left, int top, EdgePixels& pixels) const;
  void compare(const TiledCloud& cloud, int left, int top, const EdgePixels& pixels,
               Worker& worker) const;
  void sum_row(const TiledCloud& cloud, int top, RowSums& sums);
  void sum_tiles(const TiledCloud& cloud, int first, int end, int top, Worker& worker,
                 RowSums& sums) const;
  void sum_up(const Eigen::Isometry3d& T_camera_base);

  const KinematicTree& tree_;
  RegistrationOptions options_;
  Executor executor_;
  std::vector<Eigen::AlignedBox3d> boxes_;          ///< by body
  std::unique_ptr<DepthRenderer> renderer_;         ///< of pixels' centres
  std::unique_ptr<DepthRenderer> sample_renderer_;  ///< of EdgeTile::kSamples samples a pixel
  std::vector<std::unique_ptr<Worker>> workers_;

  Crop crop_{};
  std::vector<RenderItem> items_;
  RenderedDepth view_;
  std::vector<std::uint8_t> has_bend_;  ///< by pixel: whether the surface bends or breaks there
  std::vector<BodyJacobian> screws_;    ///< by body: to its twist in the camera's frame
  std::vector<std::vector<int>> variables_;  ///< by body: those that move it
  std::vector<RowSums> rows_;
  Eigen::MatrixXd sum_;
  Eigen::MatrixXd information_;
  Eigen::VectorXd gradient_;
  double pixels_ = 0.0;
  double chi_squared_ = 0.0;
};

}  // namespace lockbox
