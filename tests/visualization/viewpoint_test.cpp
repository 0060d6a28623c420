// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/viewpoint.hpp"

#include <gtest/gtest.h>

#include "block_tree.hpp"

namespace lockbox {
namespace {

TEST(Overview, SeesTheWholeModelAndFillsThePicture) {
  for (const Eigen::Vector3d& size :
       {Eigen::Vector3d(1.0, 1.0, 0.02), Eigen::Vector3d(0.1, 2.0, 0.3),
        Eigen::Vector3d(3.0, 0.1, 0.1)}) {
    const auto tree = block_tree(size, Eigen::Vector4f::Ones());
    const Viewpoint view = overview(tree, Configuration{}, 400, 300);
    double largest_share = 0.0;  // of the way from the picture's centre to its border
    for (const auto& vertex : tree.bodies[0].mesh.vertices) {
      const Eigen::Vector3d p_camera = view.T_camera_base * vertex;
      ASSERT_GT(p_camera.z(), 0.0);
      const Eigen::Vector2d pixel = view.camera.project(p_camera);
      largest_share = std::max({largest_share, std::abs(pixel.x() - 199.5) / 199.5,
                                std::abs(pixel.y() - 149.5) / 149.5});
    }
    EXPECT_LT(largest_share, 1.0) << size.transpose();
    EXPECT_GT(largest_share, 0.8) << size.transpose();
  }
}

TEST(Overview, LooksAtTheFrontFromAboveWithXToTheRight) {
  const auto tree = block_tree({1.0, 1.0, 0.02}, Eigen::Vector4f::Ones());
  const Eigen::Matrix3d R = overview(tree, Configuration{}, 400, 300).T_camera_base.linear();
  EXPECT_LT(R.col(2).z(), 0.0) << "the base's z axis points to the camera";
  EXPECT_GT(R.col(2).y(), 0.0) << "and down in the picture: the camera is above";
  EXPECT_GT(R.col(0).x(), 0.5);
  EXPECT_LT(R.col(1).y(), -0.5);
}

}  // namespace
}  // namespace lockbox
