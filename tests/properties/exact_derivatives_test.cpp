// SPDX-License-Identifier: BSD-3-Clause
// Property "exact derivatives": the gradient of every term of the image against central differences
// of its cost under one frozen selection, for every joint type, in chains of three, with a mimic
// joint.
#include <gtest/gtest.h>

#include <random>

#include "initialization/seen_model.hpp"
#include "lockbox/cloud/image_points.hpp"
#include "lockbox/model/motion_scales.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "lockbox/terms/edge_patch.hpp"
#include "lockbox/terms/free_space_term.hpp"
#include "lockbox/terms/model_term.hpp"
#include "lockbox/view/continued_edges.hpp"
#include "lockbox/view/sampling_plan.hpp"
#include "lockbox/view/view_samples.hpp"
#include "lockbox/view/visible_surface.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

BodyPoses poses_of(const ArticulatedModel& model, const Configuration& configuration) {
  BodyPoses poses;
  forward_kinematics(model.tree, configuration, poses);
  return poses;
}

class ExactDerivatives : public ::testing::Test {
 protected:
  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  const Eigen::Index unknowns = 6 + model.tree.variables();
  Executor executor{1};
  const Eigen::VectorXd scales = motion_scales(model.tree);

  /// A few millimetres and degrees off, all unknowns.
  Configuration displaced(double scale) const {
    Eigen::VectorXd step(unknowns);
    step.head<6>() << 0.003, -0.002, 0.0015, 0.01, -0.008, 0.012;
    for (Eigen::Index v = 6; v < unknowns; ++v) {
      step[v] = 0.004 * static_cast<double>(v - 4);
    }
    return stepped(truth, scale * step);
  }

  BodyPoses poses(const Configuration& configuration) const {
    return poses_of(model, configuration);
  }

  NormalEquations mapped(const std::vector<BodySystem>& systems,
                         const Configuration& configuration) const {
    std::vector<BodyJacobian> jacobians;
    body_jacobians(model.tree, poses(configuration), jacobians);
    NormalEquations equations;
    equations.set_zero(unknowns);
    for (std::size_t b = 0; b < systems.size(); ++b) {
      equations.add(systems[b], jacobians[b]);
    }
    return equations;
  }

  /// Component by component, each in its own unit: what the curvature makes of one standard
  /// deviation. Relative to the steepest component in these units.
  static void expect_equal(const NormalEquations& analytic, const Eigen::VectorXd& numeric,
                           double tolerance) {
    const Eigen::VectorXd unit = analytic.hessian.diagonal().cwiseSqrt().cwiseInverse();
    const double steepest = unit.cwiseProduct(numeric).cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < numeric.size(); ++i) {
      EXPECT_NEAR(unit[i] * analytic.gradient[i], unit[i] * numeric[i], tolerance * steepest)
          << "unknown " << i;
    }
  }

  /// Central differences of the fourth order; surfaces move by h metres, and by twice as much.
  template <typename Cost>
  Eigen::VectorXd numeric_gradient(const Configuration& at, double h, const Cost& cost) const {
    Eigen::VectorXd gradient(unknowns);
    for (Eigen::Index i = 0; i < unknowns; ++i) {
      const double e = h / scales[i];
      const auto difference = [&](double by) {
        const Eigen::VectorXd step = by * Eigen::VectorXd::Unit(unknowns, i);
        return cost(stepped(at, step)) - cost(stepped(at, -step));
      };
      gradient[i] = (8.0 * difference(e) - difference(2.0 * e)) / (12.0 * e);
    }
    return gradient;
  }
};

TEST_F(ExactDerivatives, ModelTermAgreesWithNumericalDifferentiation) {
  const TiledCloud cloud = cloud_of(measured(model, truth, "white"));
  ImagePoints points;
  points.assign(cloud, executor);
  const TermOptions options;
  VisibleSurface surface;
  PixelPrediction predicted;
  for (const double annealing_sigma : {0.0, 0.01}) {
    const Configuration at = displaced(0.7);
    surface.render(model, poses(at), cloud.camera(), cloud.camera().width, executor);
    surface.predict(points, ContinuedEdges(), executor, predicted);
    ModelTerm term;
    std::vector<BodySystem> systems(model.tree.bodies.size());
    const ModelTerm::Scene scene{model, points, cloud.camera(), predicted, options, executor};
    const double cost = term.linearize(scene, poses(at), annealing_sigma, systems);
    EXPECT_NEAR(term.cost(scene, poses(at)), cost, 1e-5 * std::abs(cost));
    const NormalEquations analytic = mapped(systems, at);
    // Interpolation makes the cost piecewise smooth: a step well below a voxel, well above
    // rounding. What is left are points that pass from cell to cell on the way.
    const Eigen::VectorXd numeric = numeric_gradient(
        at, 1e-4, [&](const Configuration& x) { return term.cost(scene, poses(x)); });
    expect_equal(analytic, numeric, 1.5e-3);
  }
}

TEST_F(ExactDerivatives, FreeSpaceTermAgreesWithNumericalDifferentiation) {
  const TiledCloud cloud = cloud_of(measured(model, truth, "white"));
  const TermOptions options;
  const Configuration at = displaced(1.5);
  VisibleSurface surface;
  surface.render(model, poses(at), cloud.camera(), cloud.camera().width, executor);
  ViewEdges edges;
  edges.find(surface.view(), executor);
  SamplingPlan plan;
  plan.plan(surface.view(), edges, 1, cloud.camera().fx, 0.0, surface.view().id.size(), executor);
  ViewSamples samples;
  samples.choose(surface, plan.density(), 1, executor);
  for (std::size_t row = 0; row < samples.rows(); ++row) samples.place_row(surface, row);
  samples.finish();
  const ContinuedEdges none;
  ContourPoints contours;
  contours.begin(surface.view());
  for (std::size_t i = 0; i < contours.bands(); ++i) {
    contours.find_band({model, surface, edges, none, 1, options}, i);
  }
  FreeSpaceTerm term;
  std::vector<BodySystem> systems(model.tree.bodies.size());
  constexpr double kAnnealingSigma = 0.005;
  term.select({model, surface, samples, contours, none, cloud, options, executor}, poses(at),
              kAnnealingSigma);
  const double cost = term.linearize(poses(at), kAnnealingSigma, systems);
  ASSERT_GT(term.matched_samples(), 50U);
  EXPECT_NEAR(term.cost(poses(at)), cost, 1e-9 * std::abs(cost));
  const NormalEquations analytic = mapped(systems, at);
  // Costs are summed in single precision: steps well above their rounding.
  const Eigen::VectorXd numeric =
      numeric_gradient(at, 4e-4, [&](const Configuration& x) { return term.cost(poses(x)); });
  expect_equal(analytic, numeric, 1e-4);
  // What the covariance takes for the scatter of this gradient.
  std::vector<TileSystem> tiles;
  term.append_tile_systems(poses(at), 0, options.lambda_free, executor, tiles);
  ASSERT_GT(tiles.size(), 20U);
  std::vector<BodySystem> sums(systems.size());
  for (const TileSystem& tile : tiles) {
    sums[static_cast<std::size_t>(tile.body)] += {tile.hessian, tile.gradient, Matrix6::Zero()};
  }
  for (std::size_t b = 0; b < systems.size(); ++b) {
    EXPECT_LT((sums[b].hessian - systems[b].hessian).norm(),
              1e-5 * systems[b].hessian.norm() + 1e-9);
    EXPECT_LT((sums[b].gradient - systems[b].gradient).norm(),
              1e-4 * analytic.gradient.norm() + 1e-9);
  }
}

/// What the pixels around the model's edges are expected to measure (1/metre), with the derivative
/// by all unknowns; of pixels that may show nothing: zero.
struct ExpectedImage {
  Eigen::VectorXd means;
  Eigen::MatrixXd derivatives;
};

ExpectedImage expected_image(const ArticulatedModel& model, const Configuration& at) {
  const PinholeCamera camera{320, 240, 290.0, 290.0, 159.5, 119.5};
  constexpr int kMargin = 2;
  BodyPoses poses = poses_of(model, at);
  std::vector<BodyJacobian> jacobians;
  body_jacobians(model.tree, poses, jacobians);
  std::vector<RenderItem> items;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    items.push_back(body_item(model.tree, b, poses[b]));
    jacobians[b] = adjoint(poses[b]) * jacobians[b];
  }
  DepthRenderer renderer(refined(camera, EdgePatch::kSamples), Executor(1));
  renderer.prepare(items);
  RenderedInverseDepth samples;
  renderer.draw({0, 0, renderer.camera().width, renderer.camera().height}, samples);
  ExpectedImage image;
  image.means.setZero(camera.width * camera.height);
  image.derivatives.setZero(image.means.size(), 6 + model.tree.variables());
  EdgePatch tile(0.5);
  const int last_left = camera.width - kMargin - EdgePatch::kSide;
  const int last_top = camera.height - kMargin - EdgePatch::kSide;
  for (int top = kMargin; top <= last_top; top += EdgePatch::kSide) {
    for (int left = kMargin; left <= last_left; left += EdgePatch::kSide) {
      if (!tile.read(samples, EdgePatch::kSamples * left - EdgePatch::kReach,
                     EdgePatch::kSamples * top - EdgePatch::kReach)) {
        continue;
      }
      for (int row = 0; row < EdgePatch::kSide; ++row) {
        tile.begin_row(row, 0, EdgePatch::kSide);
        for (int column = 0; column < EdgePatch::kSide; ++column) {
          if (tile.may_show_nothing(column, row)) continue;
          tile.look_at(column);
          const Eigen::Index pixel = (top + row) * camera.width + left + column;
          const Eigen::Vector3f ray =
              camera.back_project(left + column, top + row, 1.0).cast<float>();
          image.means[pixel] = static_cast<double>(tile.mean());
          for (std::size_t b = 0; b < tile.bodies().size(); ++b) {
            image.derivatives.row(pixel) +=
                tile.derivative(b, ray.x(), ray.y(), camera).cast<double>().transpose() *
                jacobians[static_cast<std::size_t>(tile.bodies()[b])];
          }
        }
      }
    }
  }
  return image;
}

// Samples change at edges one after the other, so that differences of single pixels are coarse; and
// over half a pixel to both sides they round off the density of the jitter, half a pixel wide.
TEST_F(ExactDerivatives, ExpectedImageAgreesWithNumericalDifferentiation) {
  const ExpectedImage here = expected_image(model, truth);
  for (Eigen::Index i = 0; i < unknowns; ++i) {
    const double h = 0.0006 / scales[i];  // half a pixel
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(unknowns, i);
    const ExpectedImage after = expected_image(model, stepped(truth, step));
    const ExpectedImage before = expected_image(model, stepped(truth, -step));
    const auto is_seen =
        here.means.array() > 0.0 && after.means.array() > 0.0 && before.means.array() > 0.0;
    const Eigen::VectorXd numeric =
        is_seen.select((after.means - before.means).array() / (2.0 * h), 0.0);
    const Eigen::VectorXd analytic = is_seen.select(here.derivatives.col(i).array(), 0.0);
    ASSERT_GT(analytic.norm(), 0.0);
    EXPECT_NEAR(numeric.dot(analytic) / analytic.squaredNorm(), 1.0, 0.05) << "unknown " << i;
    EXPECT_LT((numeric - analytic).norm(), 0.25 * analytic.norm()) << "unknown " << i;
  }
}

}  // namespace
}  // namespace lockbox
