// SPDX-License-Identifier: BSD-3-Clause
// Property "exact derivatives": every term's gradient against central differences of its cost under
// one frozen selection, for every joint type, in chains of three, with a mimic joint.
#include <gtest/gtest.h>

#include "lockbox/registration/collision_term.hpp"
#include "lockbox/registration/free_space_term.hpp"
#include "lockbox/registration/model_term.hpp"
#include "lockbox/registration/visible_surface.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

class DerivativeTest : public ::testing::Test {
 protected:
  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  const Eigen::Index unknowns = 6 + model.tree.variables();
  Executor executor{1};

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
    BodyPoses result;
    forward_kinematics(model.tree, configuration, result);
    return result;
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

  template <typename Cost>
  Eigen::VectorXd numeric_gradient(const Configuration& at, double h, const Cost& cost) const {
    Eigen::VectorXd gradient(unknowns);
    for (Eigen::Index i = 0; i < unknowns; ++i) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(unknowns, i);
      gradient[i] = (cost(stepped(at, step)) - cost(stepped(at, -step))) / (2.0 * h);
    }
    return gradient;
  }
};

TEST_F(DerivativeTest, ModelTermAgreesWithNumericalDifferentiation) {
  const TiledCloud cloud = cloud_of(measured(model, truth, "white"));
  const RegistrationOptions options;
  VisibleSurface surface;
  std::vector<float> visible;
  for (const double spread : {0.0, 0.01}) {
    const Configuration at = displaced(0.7);
    surface.render(model, poses(at), cloud.camera(), executor);
    surface.label(cloud, visible);
    ModelTerm term;
    std::vector<BodySystem> systems(model.tree.bodies.size());
    const double cost =
        term.linearize(model, poses(at), cloud, visible, options, spread, executor, systems);
    EXPECT_NEAR(term.cost(model, poses(at), cloud, visible, executor), cost, 1e-5 * std::abs(cost));
    const NormalEquations analytic = mapped(systems, at);
    // Interpolation makes the cost piecewise smooth: a step well below a voxel, well above
    // rounding.
    const Eigen::VectorXd numeric = numeric_gradient(at, 1e-5, [&](const Configuration& x) {
      return term.cost(model, poses(x), cloud, visible, executor);
    });
    for (Eigen::Index i = 0; i < unknowns; ++i) {
      EXPECT_NEAR(analytic.gradient[i], numeric[i], 0.01 * numeric.cwiseAbs().maxCoeff() + 1.0)
          << "unknown " << i << ", spread " << spread;
    }
  }
}

TEST_F(DerivativeTest, FreeSpaceTermAgreesWithNumericalDifferentiation) {
  const TiledCloud cloud = cloud_of(measured(model, truth, "white"));
  const RegistrationOptions options;
  // All that was measured before the wall is the object.
  std::vector<std::uint8_t> object(cloud.depth().size());
  for (std::size_t i = 0; i < object.size(); ++i) {
    object[i] = cloud.depth()[i] > 0.0F && cloud.depth()[i] < 1.0F ? 1 : 0;
  }
  const Configuration at = displaced(1.5);
  VisibleSurface surface;
  surface.render(model, poses(at), cloud.camera(), executor);
  FreeSpaceTerm term;
  std::vector<BodySystem> systems(model.tree.bodies.size());
  constexpr double kSpread = 0.005;
  term.select(model, surface, poses(at), cloud, object, options, kSpread, executor);
  const double cost = term.linearize(poses(at), kSpread, systems);
  ASSERT_GT(term.pulled_samples(), 50U);
  EXPECT_NEAR(term.cost(poses(at)), cost, 1e-9 * std::abs(cost));
  const NormalEquations analytic = mapped(systems, at);
  const Eigen::VectorXd numeric =
      numeric_gradient(at, 1e-6, [&](const Configuration& x) { return term.cost(poses(x)); });
  EXPECT_LT((analytic.gradient - numeric).norm(), 1e-5 * numeric.norm());
}

TEST_F(DerivativeTest, CollisionTermAgreesWithNumericalDifferentiation) {
  RegistrationOptions options;
  options.collision = CollisionMode::literal;
  CollisionTerm term(model, options);
  // Within its limits the mechanism keeps all parts apart or flush. Beyond them, at 0.13 m, the
  // block reaches 5 mm into the follower.
  Configuration at = truth;
  at.q[0] = 0.13;
  NormalEquations equations;
  equations.set_zero(unknowns);
  const double cost = term.evaluate(model, poses(at), &equations);
  ASSERT_GT(cost, 0.0);
  EXPECT_NEAR(term.evaluate(model, poses(at), nullptr), cost, 1e-12 * std::max(1.0, cost));
  const Eigen::VectorXd numeric = numeric_gradient(
      at, 1e-6, [&](const Configuration& x) { return term.evaluate(model, poses(x), nullptr); });
  EXPECT_LT((equations.gradient - numeric).norm(), 0.02 * numeric.norm() + 1e-6);
  EXPECT_EQ(equations.gradient.head<6>(), Eigen::VectorXd::Zero(6))
      << "the base carries all bodies";
}

}  // namespace
}  // namespace lockbox
