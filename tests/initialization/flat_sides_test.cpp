// SPDX-License-Identifier: BSD-3-Clause
#include "flat_sides.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "height_template.hpp"
#include "lockbox/evaluation/free_form_object.hpp"
#include "lockbox/mesh/primitives.hpp"
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
TEST(HeightTemplates, OfRoundThingsAreFew) {
  for (std::uint64_t number = 0; number < 3; ++number) {
    const FreeFormObject object = draw_free_form(ObjectBlock("tune"), number);
    const KinematicTree tree = body_of(object.links.front().mesh);
    EXPECT_LE(make_height_templates(tree, Executor(1), nullptr).size(), 12U) << object.name;
    EXPECT_LT(flat_share(tree), 0.3) << object.name;
  }
}

void add_box(const Eigen::Vector3d& size, const Eigen::Vector3d& centre, TriangleMesh& mesh) {
  TriangleMesh box = make_box(size);
  for (Eigen::Vector3d& vertex : box.vertices) vertex += centre;
  append(mesh, box);
}

/// Of a chest whose sides have six times the area of a drawer's front, and its back has eight
/// times.
TEST(HeightTemplates, AreThereOfTheFrontsOfSmallDrawers) {
  TriangleMesh carcass;
  for (const double side : {-1.0, 1.0}) {
    add_box({0.02, 0.5, 0.8}, {0.26 * side, 0.0, 0.4}, carcass);
  }
  add_box({0.5, 0.02, 0.8}, {0.0, 0.26, 0.4}, carcass);
  KinematicTree tree = body_of(std::move(carcass));
  for (int drawer = 0; drawer < 8; ++drawer) {
    Joint joint;
    joint.type = JointType::prismatic;
    joint.child_body = drawer + 1;
    joint.axis = -Eigen::Vector3d::UnitY();
    joint.upper = 0.3;
    joint.variable = drawer;
    tree.joints.push_back(joint);
    tree.variable_joint.push_back(drawer);
    Body& body = tree.bodies.emplace_back();
    body.parent_joint = drawer;
    add_box({0.5, 0.02, 0.095}, {0.0, -0.26, 0.05 + 0.1 * drawer}, body.mesh);
  }
  const auto templates = make_height_templates(tree, Executor(1), nullptr);
  for (int drawer = 1; drawer <= 8; ++drawer) {
    EXPECT_TRUE(std::any_of(templates.begin(), templates.end(),
                            [&](const HeightTemplate& height_template) {
                              return height_template.body == drawer &&
                                     height_template.T_body_plane.linear().col(2).y() < -0.99;
                            }))
        << drawer;
  }
}

}  // namespace
}  // namespace lockbox
