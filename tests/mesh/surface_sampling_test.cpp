// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/surface_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lockbox/core/error.hpp"
#include "lockbox/mesh/primitives.hpp"

namespace lockbox {
namespace {

using Eigen::Vector3d;

/// Every triangle in four, for some rounds.
TriangleMesh finely_cut(TriangleMesh mesh, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    TriangleMesh finer;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto [a, b, c] = mesh.corners(t);
      const auto v = static_cast<std::uint32_t>(finer.vertices.size());
      finer.vertices.insert(finer.vertices.end(),
                            {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)});
      finer.triangles.insert(
          finer.triangles.end(),
          {{v, v + 3, v + 5}, {v + 3, v + 1, v + 4}, {v + 5, v + 4, v + 2}, {v + 3, v + 4, v + 5}});
    }
    mesh = std::move(finer);
  }
  return mesh;
}

TEST(SurfaceSampling, StandsForTheWholeArea) {
  const TriangleMesh mesh = make_cylinder(0.03, 0.1);
  const auto samples = sample_surface(mesh, 0.002);
  double area = 0.0;
  for (const SurfaceSample& sample : samples) {
    area += sample.area;
    EXPECT_NEAR(sample.normal.norm(), 1.0, 1e-12);
    EXPECT_GT(sample.normal.dot(sample.position), 0.0);
  }
  EXPECT_NEAR(area, surface_area(mesh), 1e-12);
  EXPECT_NEAR(static_cast<double>(samples.size()), surface_area(mesh) / 4e-6, 1.0);
}

TEST(SurfaceSampling, NeighboursFollowEachOther) {
  const double spacing = 0.01;
  const auto samples = sample_surface(make_box({0.9, 0.9, 0.02}), spacing);
  double way = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    way += (samples[i].position - samples[i - 1].position).norm();
  }
  EXPECT_LT(way / static_cast<double>(samples.size()), 3.0 * spacing);
}

TEST(SurfaceSampling, LeavesNoGapsAndMakesNoClusters) {
  const double spacing = 0.01;
  for (const int rounds : {0, 5}) {
    const TriangleMesh mesh = finely_cut(make_box({0.4, 0.3, 0.02}), rounds);
    const auto samples = sample_surface(mesh, spacing);
    for (const SurfaceSample& probe : sample_surface(make_box({0.4, 0.3, 0.02}), 0.004)) {
      const auto near = std::count_if(samples.begin(), samples.end(), [&](const auto& sample) {
        return (sample.position - probe.position).norm() < 2.5 * spacing &&
               sample.normal.dot(probe.normal) > 0.5;
      });
      EXPECT_GE(near, 1) << probe.position.transpose() << " after " << rounds;
      EXPECT_LE(near, 40) << probe.position.transpose() << " after " << rounds;
    }
  }
}

TEST(SurfaceSampling, ForgetsTheOrderOfTheTriangles) {
  TriangleMesh mesh = make_sphere(0.03);
  const auto samples = sample_surface(mesh, 0.004);
  std::mt19937 random(4);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  const auto shuffled = sample_surface(mesh, 0.004);
  ASSERT_EQ(samples.size(), shuffled.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_TRUE(samples[i].position.isApprox(shuffled[i].position, 1e-9));
  }
}

TEST(SurfaceSampling, GivesATinySurfaceOneSample) {
  EXPECT_EQ(sample_surface(make_box({1e-3, 1e-3, 1e-3}), 1.0).size(), 1U);
  EXPECT_TRUE(sample_surface({}, 1.0).empty());
}

TEST(SurfaceSampling, TakesNoMemoryForWhatNoObjectHas) {
  EXPECT_THROW(sample_surface(make_box({60.0, 60.0, 60.0}), 0.001), InputError);
}

}  // namespace
}  // namespace lockbox
