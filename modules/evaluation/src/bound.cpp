// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/bound.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "noise_field.hpp"
#include "pixel_model.hpp"
#include "sampled_view.hpp"

namespace lockbox {
struct DepthInformation::Workspace {
  Workspace(const KinematicTree& model, const PinholeCamera& pinhole,
            const SensorModel& depth_sensor, const Executor& workers)
      : tree(model),
        camera(pinhole),
        executor(workers),
        view(pinhole, depth_sensor, workers),
        pixels(view, pinhole, depth_sensor, static_cast<int>(model.bodies.size())) {
    if (depth_sensor.correlation_length > 0.0 && depth_sensor.disparity_noise > 0.0) {
      noise.emplace(depth_sensor, pinhole, workers);
    }
  }

  void place(const Configuration& configuration, std::span<const RenderItem> scenery);
  Eigen::MatrixXd sum_row(int v);

  const KinematicTree& tree;
  PinholeCamera camera;
  Executor executor;
  SampledView view;
  PixelModeler pixels;
  std::optional<NoiseField> noise;  ///< if the sensor's is correlated

  std::vector<RenderItem> items;
  std::vector<Eigen::Isometry3d> T_camera_body;
  std::vector<BodyJacobian> jacobians;  ///< to twists in the camera's frame
  ChannelImage weights;                 ///< chance to be measured / variance of each pixel
  ChannelImage weighted;                ///< the same times the derivative by all unknowns
};

void DepthInformation::Workspace::place(const Configuration& configuration,
                                        std::span<const RenderItem> scenery) {
  forward_kinematics(tree, configuration, T_camera_body);
  body_jacobians(tree, T_camera_body, jacobians);
  items.clear();
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    jacobians[b] = adjoint(T_camera_body[b]) * jacobians[b];
    items.push_back(body_item(tree, b, T_camera_body[b]));
  }
  for (RenderItem item : scenery) {
    item.id = static_cast<std::int16_t>(tree.bodies.size());
    items.push_back(item);
  }
}

/// Sums the pixels of a row, as if they erred independently; their weights go into the images.
Eigen::MatrixXd DepthInformation::Workspace::sum_row(int v) {
  const Eigen::Index unknowns = tree.unknowns();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd derivative(unknowns);
  PixelModel pixel;
  for (int u = 0; u < camera.width; ++u) {
    pixels.model(u, v, pixel);
    if (pixel.measured == 0.0) continue;
    const double weight = pixel.measured / pixel.variance;
    *weights.at(u, v) = weight;
    if (pixel.derivatives.empty()) continue;
    derivative.setZero();
    for (const auto& [body, by_twist] : pixel.derivatives) {
      derivative.noalias() += jacobians[static_cast<std::size_t>(body)].transpose() * by_twist;
    }
    Eigen::Map<Eigen::VectorXd>(weighted.at(u, v), unknowns) = weight * derivative;
    information.selfadjointView<Eigen::Lower>().rankUpdate(derivative, weight);
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
  const Eigen::Index unknowns = w.tree.unknowns();
  w.weights.resize(w.camera.width, w.camera.height, 1);
  w.weighted.resize(w.camera.width, w.camera.height, static_cast<std::size_t>(unknowns));
  std::vector<Eigen::MatrixXd> rows(static_cast<std::size_t>(w.camera.height));
  w.executor.for_each(rows.size(),
                      [&](std::size_t v) { rows[v] = w.sum_row(static_cast<int>(v)); });
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (const Eigen::MatrixXd& row : rows) lower += row;
  Eigen::MatrixXd information = lower.selfadjointView<Eigen::Lower>();
  if (w.noise) information -= w.noise->lost_information(w.weights, w.weighted);
  return information;
}

// Scaled to a unit diagonal, so that metres and radians of all joints are alike.
Eigen::VectorXd bound_sigma(const Eigen::MatrixXd& information) {
  // Smaller eigenvalues are zeros: what conjugate gradients leave of one stays below 1e-6.
  constexpr double kZero = 1e-5;
  // An unknown with a larger share in their directions is not determined.
  constexpr double kNullShare = 1e-6;
  const Eigen::ArrayXd diagonal = information.diagonal().array();
  const Eigen::ArrayXd scale = (diagonal > 0.0).select(diagonal.max(1e-300).rsqrt(), 0.0);
  const Eigen::MatrixXd scaled =
      scale.matrix().asDiagonal() * information * scale.matrix().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  Eigen::VectorXd sigma(information.rows());
  for (Eigen::Index i = 0; i < sigma.size(); ++i) {
    const Eigen::ArrayXd shares = eigen.eigenvectors().row(i).array().square();
    const auto is_null = eigen.eigenvalues().array() < kZero;
    const double null_share = is_null.select(shares, 0.0).sum();
    const double variance = is_null.select(0.0, shares / eigen.eigenvalues().array()).sum();
    const double deviation = scale[i] * std::sqrt(variance);
    const bool determined = scale[i] > 0.0 && null_share < kNullShare && deviation < kNoInformation;
    sigma[i] = determined ? deviation : std::numeric_limits<double>::infinity();
  }
  return sigma;
}

}  // namespace lockbox
