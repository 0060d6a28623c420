// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/bound.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lockbox/model/forward_kinematics.hpp"
#include "pixel_model.hpp"
#include "sampled_view.hpp"

namespace lockbox {
namespace {

/// Sums over the pixels of a tile, in which the disparity noise is one unknown number.
class TileInformation {
 public:
  explicit TileInformation(Eigen::Index unknowns) { set_zero(unknowns); }

  void set_zero(Eigen::Index unknowns) {
    squares_.setZero(unknowns, unknowns);
    sums_.setZero(unknowns);
    weight_ = 0.0;
  }

  void add_static(double weight) { weight_ += weight; }

  void add(const Eigen::VectorXd& derivative, double weight) {
    squares_.selfadjointView<Eigen::Lower>().rankUpdate(derivative, weight);
    sums_ += weight * derivative;
    weight_ += weight;
  }

  /// noise_variance: of the common number. Adds the lower triangle.
  void add_to(Eigen::MatrixXd& information, double noise_variance) const {
    information += squares_;
    const double known = noise_variance / (1.0 + noise_variance * weight_);
    information.selfadjointView<Eigen::Lower>().rankUpdate(sums_, -known);
  }

 private:
  Eigen::MatrixXd squares_;
  Eigen::VectorXd sums_;
  double weight_ = 0.0;
};

}  // namespace

struct DepthInformation::Workspace {
  Workspace(const KinematicTree& model, const PinholeCamera& pinhole,
            const SensorModel& depth_sensor, const Executor& workers)
      : tree(model),
        camera(pinhole),
        executor(workers),
        view(pinhole, depth_sensor, workers),
        pixels(view, depth_sensor, static_cast<int>(model.bodies.size())) {
    if (depth_sensor.correlation_length == 0.0) return;
    const double area = correlation_area(depth_sensor);
    tile = std::max(1, static_cast<int>(std::lround(std::sqrt(area))));
    tile_variance =
        depth_sensor.disparity_noise * depth_sensor.disparity_noise * area / (tile * tile);
  }

  void place(const Configuration& configuration, std::span<const RenderItem> scenery);
  Eigen::MatrixXd sum_tile_row(int first_row) const;

  const KinematicTree& tree;
  PinholeCamera camera;
  Executor executor;
  SampledView view;
  PixelModeler pixels;
  int tile = 8;                ///< side, pixels
  double tile_variance = 0.0;  ///< of the disparity noise that a tile has in common, pixels^2

  std::vector<RenderItem> items;
  std::vector<Eigen::Isometry3d> T_camera_body;
  std::vector<BodyJacobian> jacobians;  ///< to twists in the camera's frame
};

void DepthInformation::Workspace::place(const Configuration& configuration,
                                        std::span<const RenderItem> scenery) {
  forward_kinematics(tree, configuration, T_camera_body);
  body_jacobians(tree, T_camera_body, jacobians);
  items.clear();
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    jacobians[b] = adjoint(T_camera_body[b]) * jacobians[b];
    items.push_back({&tree.bodies[b].mesh, T_camera_body[b], static_cast<std::int16_t>(b)});
  }
  for (RenderItem item : scenery) {
    item.id = static_cast<std::int16_t>(tree.bodies.size());
    items.push_back(item);
  }
}

Eigen::MatrixXd DepthInformation::Workspace::sum_tile_row(int first_row) const {
  const Eigen::Index unknowns = 6 + tree.variables();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(unknowns, unknowns);
  TileInformation sums(unknowns);
  Eigen::VectorXd derivative(unknowns);
  PixelModel pixel;
  const int last_row = std::min(first_row + tile, camera.height);
  for (int first = 0; first < camera.width; first += tile) {
    sums.set_zero(unknowns);
    for (int v = first_row; v < last_row; ++v) {
      for (int u = first; u < std::min(first + tile, camera.width); ++u) {
        pixels.model(u, v, pixel);
        if (pixel.measured == 0.0) continue;
        const double weight = pixel.measured / pixel.variance;
        if (pixel.derivatives.empty()) {
          sums.add_static(weight);
          continue;
        }
        derivative.setZero();
        for (const auto& [body, by_twist] : pixel.derivatives) {
          derivative.noalias() += jacobians[static_cast<std::size_t>(body)].transpose() * by_twist;
        }
        sums.add(derivative, weight);
      }
    }
    sums.add_to(information, tile_variance);
  }
  return information;
}

DepthInformation::DepthInformation(const KinematicTree& tree, const PinholeCamera& camera,
                                   const SensorModel& sensor, const Executor& executor)
    : workspace_(std::make_unique<Workspace>(tree, camera, sensor, executor)) {}

DepthInformation::~DepthInformation() = default;
DepthInformation::DepthInformation(DepthInformation&&) noexcept = default;
DepthInformation& DepthInformation::operator=(DepthInformation&&) noexcept = default;

Eigen::MatrixXd DepthInformation::compute(const Configuration& configuration,
                                          std::span<const RenderItem> scenery) {
  Workspace& w = *workspace_;
  w.place(configuration, scenery);
  w.view.render(w.items);
  const auto tile = static_cast<std::size_t>(w.tile);
  std::vector<Eigen::MatrixXd> rows(chunk_count(static_cast<std::size_t>(w.camera.height), tile));
  w.executor.for_each(rows.size(),
                      [&](std::size_t i) { rows[i] = w.sum_tile_row(static_cast<int>(i * tile)); });
  const Eigen::Index unknowns = 6 + w.tree.variables();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (const Eigen::MatrixXd& row : rows) information += row;
  return information.selfadjointView<Eigen::Lower>();
}

// Scaled to a unit diagonal, so that metres and radians of all joints are alike.
Eigen::VectorXd bound_sigma(const Eigen::MatrixXd& information) {
  constexpr double kRounding = 1e-12;  ///< smaller eigenvalues are zeros
  constexpr double kPartOfNull = 1e-6;
  const Eigen::ArrayXd diagonal = information.diagonal().array();
  const Eigen::ArrayXd scale = (diagonal > 0.0).select(diagonal.max(1e-300).rsqrt(), 0.0);
  const Eigen::MatrixXd scaled =
      scale.matrix().asDiagonal() * information * scale.matrix().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  Eigen::VectorXd sigma(information.rows());
  for (Eigen::Index i = 0; i < sigma.size(); ++i) {
    const Eigen::ArrayXd shares = eigen.eigenvectors().row(i).array().square();
    const auto is_null = eigen.eigenvalues().array() < kRounding;
    const double null_share = is_null.select(shares, 0.0).sum();
    const double variance = is_null.select(0.0, shares / eigen.eigenvalues().array()).sum();
    const double deviation = scale[i] * std::sqrt(variance);
    const bool determined =
        scale[i] > 0.0 && null_share < kPartOfNull && deviation < kNoInformation;
    sigma[i] = determined ? deviation : std::numeric_limits<double>::infinity();
  }
  return sigma;
}

}  // namespace lockbox
