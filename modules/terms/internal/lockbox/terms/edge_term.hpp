// SPDX-License-Identifier: BSD-3-Clause
// What the image tells at the model's own edges, by all that the sensor's noise lets it tell: where
// a part stands out of the board, pixels see the one or the other, more or less often; and errors
// of neighbouring pixels go together, so that small steps between them are exact.
//
// The likelihood of the measured inverse depths d, chi^2 = r' C^-1 r with r = d -
// mean(configuration) (edge_patch.hpp, patch_noise.hpp), and its derivative. Only the pixels around
// edges count, in patches of 8 x 8 pixels: elsewhere points tell as much, and contours before
// anything that is not of the model have an unknown side. Where the patches are, a coarse view
// tells (edge_selection.hpp); only they are drawn closely. Good for the last step: from farther
// than an edge is blurred, it leads nowhere.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/solver/normal_equations.hpp"
#include "lockbox/terms/edge_selection.hpp"
#include "lockbox/view/continued_edges.hpp"
#include "lockbox/view/view_detail.hpp"
#include "lockbox/view/view_options.hpp"
#include "lockbox/view/visible_surface.hpp"

namespace lockbox {

/// Reuses its buffers. The tree is referred to.
class EdgeTerm {
 public:
  EdgeTerm(const KinematicTree& tree, const ViewOptions& options, const Executor& executor);
  ~EdgeTerm();
  EdgeTerm(EdgeTerm&&) noexcept;

  /// Compares the image, which the cloud must have, with the model there. view: of the model where
  /// it is, or very near; tells which patches show edges. patches_per_joint: of those that are
  /// compared, for each variable those that tell most; kAllPatches, or without joints: all.
  /// Edges beyond which the scene goes on are left out.
  void linearize(const TiledCloud& cloud, const VisibleSurface& view,
                 const ContinuedEdges& continued, std::size_t patches_per_joint,
                 const BodyPoses& T_camera_body, const std::vector<BodyJacobian>& jacobians);

  /// chi^2 / 2 as a function of a step (base twist, joint variables), at the configuration drawn.
  const Eigen::MatrixXd& information() const { return information_; }
  const Eigen::VectorXd& gradient() const { return gradient_; }

  /// Returns how many pixels are compared.
  double pixels() const { return pixels_; }
  double chi_squared() const { return chi_squared_; }

 private:
  struct Worker;
  /// Tiles of a row that one thread compares, and sums over them. Step: base twist in the camera's
  /// frame, joint variables, and the residual as if it were one more.
  struct Strip {
    int row;
    std::span<const int> columns;
    double pixels;
    Eigen::MatrixXd products;
  };
  void prepare(const PinholeCamera& camera, const BodyPoses& T_camera_body);
  void draw_samples(int first_column, int end_column, int row, RenderedInverseDepth& samples) const;
  void express_in_camera(const BodyPoses& T_camera_body,
                         const std::vector<BodyJacobian>& jacobians);
  void cut_into_strips();
  void sum_strip(const TiledCloud& cloud, Strip& strip);
  void sum_neighbours(const TiledCloud& cloud, int first_column, int end_column, Worker& worker,
                      Strip& strip) const;
  void compare(const TiledCloud& cloud, const Pixel& first, Worker& worker) const;
  void find_edges(const TiledCloud& cloud, const Pixel& first, int row, Worker& worker) const;
  void compare_pixel(const TiledCloud& cloud, const Pixel& first, int column, int row,
                     Worker& worker) const;
  void sum_up(const Eigen::Isometry3d& T_camera_base);

  const KinematicTree& tree_;
  ViewOptions options_;
  Executor executor_;
  float least_bend_;  ///< 1/metre: what bends less from pixel to pixel tells nothing
  EdgeSelection selection_;
  const VisibleSurface* view_ = nullptr;            ///< of the last linearisation
  const ContinuedEdges* continued_ = nullptr;       ///< the same
  std::unique_ptr<DepthRenderer> sample_renderer_;  ///< of EdgePatch::kSamples samples a pixel
  std::vector<std::unique_ptr<Worker>> workers_;

  std::vector<RenderItem> items_;
  std::vector<BodyJacobian> screws_;         ///< by body: to its twist in the camera's frame
  std::vector<std::vector<int>> variables_;  ///< by body: those that move it
  std::vector<Strip> strips_;                ///< more are kept for later
  std::size_t strip_count_ = 0;
  Eigen::MatrixXd sum_;
  Eigen::MatrixXd information_;
  Eigen::VectorXd gradient_;
  double pixels_ = 0.0;
  double chi_squared_ = 0.0;
};

}  // namespace lockbox
