// SPDX-License-Identifier: BSD-3-Clause
// What does a view determine? The facets and voxels of a round part without marks must not be taken
// for an angle.
#include <gtest/gtest.h>

#include <string>

#include "lockbox/core/lie.hpp"
#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/solver/normal_equations.hpp"
#include "mechanism.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

constexpr int kDial = 6;  ///< its unknown

/// A disk on a plate, with a handle or without.
ArticulatedModel dial(const std::string& handle) {
  const TemporaryFolder folder;
  const auto file = folder.write("dial.urdf", R"(<robot name="dial">
  <link name="plate"><visual><geometry><box size="0.4 0.3 0.02"/></geometry></visual></link>
  <link name="disk">
    <visual><geometry><cylinder radius="0.08" length="0.03"/></geometry></visual>)" +
                                                  handle + R"(
  </link>
  <joint name="dial" type="continuous">
    <parent link="plate"/><child link="disk"/><origin xyz="0.03 0.02 0.025"/><axis xyz="0 0 1"/>
  </joint>
</robot>
)");
  LoadOptions options;
  options.cache_directory = std::filesystem::path();
  return load_model(file, options);
}

Configuration seen_from_front(const ArticulatedModel& model) {
  Configuration configuration = mechanism_start(mechanism());
  configuration.q = Eigen::VectorXd::Constant(model.tree.variables(), 0.4);
  return configuration;
}

TEST(Information, ASmoothDiskHasNoAngleAndStandsStill) {
  const ArticulatedModel model = dial("");
  const Configuration truth = seen_from_front(model);
  ArticulatedRegistration registration(model, {}, Executor(1));
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const TiledCloud cloud = cloud_of(measured(model, truth, "primesense", seed));
    const RegistrationResult& result = registration.align(cloud, truth, {0.005, 5});
    EXPECT_FALSE(result.observable[kDial]) << "seed " << seed;
    EXPECT_NEAR(result.configuration.q[0], truth.q[0], 1e-6) << "seed " << seed;
  }
}

TEST(Information, AHandleTellsTheAngle) {
  const ArticulatedModel model = dial(
      R"(<visual><origin xyz="0.04 0 0.025"/><geometry><box size="0.08 0.02 0.03"/></geometry></visual>)");
  const Configuration truth = seen_from_front(model);
  ArticulatedRegistration registration(model, {}, Executor(1));
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const TiledCloud cloud = cloud_of(measured(model, truth, "primesense", seed));
    Configuration start = truth;
    start.q[0] += 0.05;
    const RegistrationResult& result = registration.align(cloud, start, {0.005, 10});
    EXPECT_TRUE(result.observable[kDial]) << "seed " << seed;
    EXPECT_NEAR(result.configuration.q[0], truth.q[0], 4.0 * result.sigma[kDial])
        << "seed " << seed;
  }
}

TEST(Information, WrongNormalsFeignWhatTheirMeanOverAllDirectionsSays) {
  const std::vector<Eigen::Vector3d> points{{0.1, -0.2, 0.3}, {-0.05, 0.4, 0.02}, {0.3, 0.3, -0.1}};
  constexpr double kWeight = 2.0;
  constexpr double kVariance = 1e-3;
  Matrix6 expected = Matrix6::Zero();
  kernels::NormalSums sums{};
  for (const Eigen::Vector3d& p : points) {
    for (int axis = 0; axis < 3; ++axis) {  // any three orthogonal ones have the mean of all
      const Eigen::Vector3d e = Eigen::Vector3d::Unit(axis);
      Twist row;
      row << e, p.cross(e);
      expected += kWeight * kVariance * row * row.transpose();
    }
    sums.mass += 1.0;
    int k = 0;
    for (int r = 0; r < 3; ++r) {
      sums.first_moment[r] += p[r];
      for (int c = r; c < 3; ++c) sums.second_moment[k++] += p[r] * p[c];
    }
  }
  const BodySystem system = to_system(sums, kWeight, kVariance);
  EXPECT_LT((system.feigned - expected).norm(), 1e-12);
}

}  // namespace
}  // namespace lockbox
