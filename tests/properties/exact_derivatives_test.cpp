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
  const Eigen::Index unknowns = model.tree.unknowns();
  Executor executor{1};
  static constexpr int kSteps = 9;
  const Eigen::VectorXd scales = motion_scales(model.tree);

  /// Off by one unknown, so that no component of the gradient is steeper, each in its own unit:
  /// poses are rounded to single precision, which moves bodies along all of them. Surfaces move by
  /// so many metres.
  Configuration displaced(Eigen::Index unknown, double metres) const {
    return stepped(truth, metres / scales[unknown] * Eigen::VectorXd::Unit(unknowns, unknown));
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

  /// Central differences of the fourth order; surfaces move by h metres, and by twice as much. The
  /// mean is taken over steps that differ a little, because of the rounding.
  template <typename Cost>
  double numeric_derivative(const Configuration& at, Eigen::Index unknown, double h,
                            const Cost& cost) const {
    const auto difference = [&](double by) {
      const Eigen::VectorXd step = by * Eigen::VectorXd::Unit(unknowns, unknown);
      return cost(stepped(at, step)) - cost(stepped(at, -step));
    };
    double derivative = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      const double e = (0.8 + 0.4 * k / (kSteps - 1)) * h / scales[unknown];
      derivative += (8.0 * difference(e) - difference(2.0 * e)) / (12.0 * e * kSteps);
    }
    return derivative;
  }

  static void expect_equal(double analytic, double numeric, Eigen::Index unknown) {
    EXPECT_NEAR(analytic, numeric, 1e-4 * std::abs(numeric)) << "unknown " << unknown;
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
  struct Case {
    double annealing_sigma;  ///< metres
    double displacement;     ///< metres, within the gates
    double step;             ///< metres: below a cell and the sigma, above rounding
  };
  const TiledCloud cloud = cloud_of(measured(model, truth, "white"));
  const TermOptions options;
  VisibleSurface surface;
  PixelPrediction predicted;
  ModelTerm term;
  for (const Case& one : {Case{0.0, 0.002, 2e-4}, Case{0.01, 0.01, 4e-4}}) {
    for (Eigen::Index i = 0; i < unknowns; ++i) {
      const Configuration at = displaced(i, one.displacement);
      TiledCloud inside = cloud;
      leave_out_borders(model, poses(at), 2.5 * one.step, inside);
      ImagePoints points;
      points.assign(inside, executor);
      surface.render(model, poses(at), cloud.camera(), cloud.camera().width, executor);
      surface.predict(points, ContinuedEdges(), executor, predicted);
      std::vector<BodySystem> systems(model.tree.bodies.size());
      const ModelTerm::Scene scene{model, points, cloud.camera(), predicted, options, executor};
      const double cost = term.linearize(scene, poses(at), one.annealing_sigma, systems);
      ASSERT_GT(term.totals().points, 1000.0);
      EXPECT_NEAR(term.cost(scene, poses(at)), cost, 1e-5 * std::abs(cost));
      const double numeric = numeric_derivative(
          at, i, one.step, [&](const Configuration& x) { return term.cost(scene, poses(x)); });
      expect_equal(mapped(systems, at).gradient[i], numeric, i);
    }
  }
}

/// The term of what violates free space at a configuration, and of contours there.
class ExactDerivativesOfFreeSpace : public ExactDerivatives {
 protected:
  static constexpr double kAnnealingSigma = 0.005;  // metres

  /// Returns the cost.
  double linearize(const Configuration& at) {
    surface_.render(model, poses(at), cloud_.camera(), cloud_.camera().width, executor);
    edges_.find(surface_.view(), executor);
    plan_.plan(surface_.view(), edges_, 1, cloud_.camera().fx, 0.0, surface_.view().id.size(),
               executor);
    samples_.choose(surface_, plan_.density(), 1, executor);
    for (std::size_t row = 0; row < samples_.rows(); ++row) samples_.place_row(surface_, row);
    samples_.finish();
    contours_.begin(surface_.view());
    for (std::size_t i = 0; i < contours_.bands(); ++i) {
      contours_.find_band({model, surface_, edges_, none_, 1, options_}, i);
    }
    term_.select({model, surface_, samples_, contours_, none_, cloud_, options_, executor},
                 poses(at), kAnnealingSigma);
    systems_.assign(model.tree.bodies.size(), BodySystem{});
    return term_.linearize(poses(at), kAnnealingSigma, systems_);
  }

  const TiledCloud cloud_ = cloud_of(measured(model, truth, "white"));
  const TermOptions options_{};
  VisibleSurface surface_;
  ViewEdges edges_;
  SamplingPlan plan_;
  ViewSamples samples_;
  const ContinuedEdges none_{};
  ContourPoints contours_;
  FreeSpaceTerm term_;
  std::vector<BodySystem> systems_;
};

TEST_F(ExactDerivativesOfFreeSpace, TermAgreesWithNumericalDifferentiation) {
  constexpr double kStep = 4e-4;  // metres: costs are summed in single precision
  for (Eigen::Index i = 0; i < unknowns; ++i) {
    const Configuration at = displaced(i, 0.005);
    const double cost = linearize(at);
    ASSERT_GT(term_.matched_samples(), 50U);
    EXPECT_NEAR(term_.cost(poses(at)), cost, 1e-9 * std::abs(cost));
    const double numeric = numeric_derivative(
        at, i, kStep, [&](const Configuration& x) { return term_.cost(poses(x)); });
    expect_equal(mapped(systems_, at).gradient[i], numeric, i);
  }
}

/// The clusters of residuals, whose scatter the covariance takes for that of the gradient.
TEST_F(ExactDerivativesOfFreeSpace, ClustersSumUpToTheSystems) {
  for (Eigen::Index i = 0; i < unknowns; ++i) {
    const Configuration at = displaced(i, 0.005);
    linearize(at);
    std::vector<TileSystem> tiles;
    term_.append_tile_systems(poses(at), 0, options_.lambda_free, executor, tiles);
    ASSERT_GT(tiles.size(), 20U);
    std::vector<BodySystem> sums(systems_.size());
    for (const TileSystem& tile : tiles) {
      sums[static_cast<std::size_t>(tile.body)] += {tile.hessian, tile.gradient, Matrix6::Zero()};
    }
    for (std::size_t b = 0; b < systems_.size(); ++b) {
      EXPECT_LT((sums[b].hessian - systems_[b].hessian).norm(),
                1e-5 * systems_[b].hessian.norm() + 1e-9);
      // Each component of the gradient as a share of its standard deviation.
      const Twist unit = systems_[b].hessian.diagonal().cwiseSqrt();
      EXPECT_TRUE(((sums[b].gradient - systems_[b].gradient).cwiseAbs().array() <=
                   1e-4 * unit.array() + 1e-9)
                      .all())
          << (sums[b].gradient - systems_[b].gradient).cwiseQuotient(unit).transpose();
    }
  }
}

}  // namespace
}  // namespace lockbox
