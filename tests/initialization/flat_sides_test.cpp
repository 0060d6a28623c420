// SPDX-License-Identifier: BSD-3-Clause
#include "flat_sides.hpp"

#include <gtest/gtest.h>

#include "lockbox/evaluation/free_form_object.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "model_relief.hpp"
#include "model_sides.hpp"

namespace lockbox {
namespace {

KinematicTree body_of(TriangleMesh mesh) {
  KinematicTree tree;
  tree.bodies.emplace_back().mesh = std::move(mesh);
  return tree;
}

TEST(FlatSides, OfABoxAreSix) {
  EXPECT_EQ(flat_sides(make_box({0.1, 0.2, 0.3}), 0.0).size(), 6U);
  EXPECT_NEAR(flat_share(body_of(make_box({0.1, 0.2, 0.3}))), 1.0, 1e-9);
}

/// However its lateral surface is cut into faces.
TEST(FlatSides, OfACylinderAreItsEnds) {
  const auto sides = flat_sides(make_cylinder(0.1, 0.3), 0.0);
  ASSERT_EQ(sides.size(), 2U);
  for (const FlatSide& side : sides) EXPECT_NEAR(std::abs(side.normal.z()), 1.0, 1e-9);
}

TEST(FlatSides, OfASphereAreNone) {
  EXPECT_TRUE(flat_sides(make_sphere(0.1), 0.0).empty());
  EXPECT_EQ(flat_share(body_of(make_sphere(0.1))), 0.0);
}

/// An elbow has rings at its ends, whose faces are flat. Facets, of which it has thousands, would
/// each be laid onto each plane of a scene.
TEST(Reliefs, OfRoundThingsAreFew) {
  for (std::uint64_t number = 0; number < 3; ++number) {
    const FreeFormObject object = draw_free_form(ObjectBlock("tune"), number);
    const KinematicTree tree = body_of(object.links.front().mesh);
    EXPECT_LE(make_reliefs(tree, Executor(1), nullptr).size(), 12U) << object.name;
    EXPECT_LT(flat_share(tree), 0.3) << object.name;
  }
}

}  // namespace
}  // namespace lockbox
