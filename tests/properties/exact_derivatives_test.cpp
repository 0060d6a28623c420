// SPDX-License-Identifier: BSD-3-Clause
// Property "exact derivatives": the gradient of every term of the image against central differences
// of its cost under one frozen selection, for every joint type, in chains of three, with a mimic
// joint.
#include <gtest/gtest.h>

#include <random>

#include "initialization/seen_model.hpp"
#include "lockbox/cloud/image_points.hpp"
#include "lockbox/model/motion_scales.hpp"
#include "lockbox/sdf/field_cache.hpp"
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
  explicit ExactDerivatives(const ArticulatedModel& of = mechanism()) : model(of) {}

  const ArticulatedModel& model;
  const Configuration truth = mechanism_start(model);
  const Eigen::Index unknowns = 6 + model.tree.variables();
  Executor executor{1};
  static constexpr int kSteps = 9;
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
  /// Poses are rounded to single precision: so the mean is taken over steps that differ a little.
  template <typename Cost>
  Eigen::VectorXd numeric_gradient(const Configuration& at, double h, const Cost& cost) const {
    Eigen::VectorXd gradient(unknowns);
    for (Eigen::Index i = 0; i < unknowns; ++i) {
      const auto difference = [&](double by) {
        const Eigen::VectorXd step = by * Eigen::VectorXd::Unit(unknowns, i);
        return cost(stepped(at, step)) - cost(stepped(at, -step));
      };
      gradient[i] = 0.0;
      for (int k = 0; k < kSteps; ++k) {
        const double e = (0.8 + 0.4 * k / (kSteps - 1)) * h / scales[i];
        gradient[i] += (8.0 * difference(e) - difference(2.0 * e)) / (12.0 * e * kSteps);
      }
    }
    return gradient;
  }
};

/// Metres from p to where one of the cells of a grid ends that begins at the origin.
double distance_to_border(const float origin[3], float voxel, const Eigen::Vector3d& p) {
  double nearest = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = (p[axis] - static_cast<double>(origin[axis])) / static_cast<double>(voxel);
    nearest = std::min(nearest, std::abs(cells - std::round(cells)));
  }
  return nearest * static_cast<double>(voxel);
}

/// Distances are smooth within the cells of a field, and bend where one ends. Leaves out points
/// that such a border is near, metres.
void leave_out_borders(const ArticulatedModel& model, const BodyPoses& T_camera_body, double near,
                       TiledCloud& cloud) {
  constexpr double kBeyondAnyGate = 0.06;  // metres
  const PinholeCamera& camera = cloud.camera();
  std::vector<std::uint8_t> mask(cloud.depth().size(), 1);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const auto column = static_cast<int>(i) % camera.width;
    const auto row = static_cast<int>(i) / camera.width;
    const Eigen::Vector3d p = camera.back_project(column, row, cloud.depth()[i]);
    for (std::size_t b = 0; b < T_camera_body.size(); ++b) {
      const FieldView& field = model.fields[b]->view();
      const Eigen::Vector3d p_body = T_camera_body[b].inverse() * p;
      if (model.fields[b]->bounds().exteriorDistance(p_body) > kBeyondAnyGate) continue;
      if (distance_to_border(field.fine_origin, field.fine_voxel, p_body) < near ||
          distance_to_border(field.coarse_origin, field.coarse_voxel, p_body) < near) {
        mask[i] = 0;
      }
    }
  }
  cloud.keep(mask);
}

/// With cells that are large beside steps.
const ArticulatedModel& coarse_mechanism() {
  static const ArticulatedModel model = [] {
    ArticulatedModel coarse = load_mechanism(mechanism_elements(), with_cache());
    for (std::size_t b = 0; b < coarse.fields.size(); ++b) {
      FieldOptions options;
      options.voxel = std::min(0.008, 0.5 * coarse.fields[b]->thickness());
      coarse.fields[b] = load_or_build_field(coarse.tree.bodies[b].mesh, options,
                                             *with_cache().cache_directory, Executor());
    }
    return coarse;
  }();
  return model;
}

class ExactDerivativesOfFields : public ExactDerivatives {
 protected:
  ExactDerivativesOfFields() : ExactDerivatives(coarse_mechanism()) {}
};

TEST_F(ExactDerivativesOfFields, ModelTermAgreesWithNumericalDifferentiation) {
  constexpr double kStep = 2e-4;  // metres: below a cell, above rounding
  const Configuration at = displaced(0.7);
  TiledCloud cloud = cloud_of(measured(model, truth, "white"));
  leave_out_borders(model, poses(at), 2.5 * kStep, cloud);
  ImagePoints points;
  points.assign(cloud, executor);
  const TermOptions options;
  VisibleSurface surface;
  PixelPrediction predicted;
  for (const double annealing_sigma : {0.0, 0.01}) {
    surface.render(model, poses(at), cloud.camera(), cloud.camera().width, executor);
    surface.predict(points, ContinuedEdges(), executor, predicted);
    ModelTerm term;
    std::vector<BodySystem> systems(model.tree.bodies.size());
    const ModelTerm::Scene scene{model, points, cloud.camera(), predicted, options, executor};
    const double cost = term.linearize(scene, poses(at), annealing_sigma, systems);
    EXPECT_NEAR(term.cost(scene, poses(at)), cost, 1e-5 * std::abs(cost));
    const NormalEquations analytic = mapped(systems, at);
    const Eigen::VectorXd numeric = numeric_gradient(
        at, kStep, [&](const Configuration& x) { return term.cost(scene, poses(x)); });
    ASSERT_GT(term.totals().points, 1000.0);
    expect_equal(analytic, numeric, 1e-4);
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

}  // namespace
}  // namespace lockbox
