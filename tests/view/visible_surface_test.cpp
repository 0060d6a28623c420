// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/visible_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "lockbox/core/units.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

/// A box of 20 cm a metre away, turned about the camera's y axis by so many degrees.
VisibleSurface seen_box(const ArticulatedModel& box, double turn) {
  Configuration configuration{Eigen::Isometry3d::Identity(), {}};
  configuration.T_camera_base = Eigen::Translation3d(0.0, 0.0, 1.0) *
                                Eigen::AngleAxisd(turn * kRadians, Eigen::Vector3d::UnitY());
  BodyPoses poses;
  forward_kinematics(box.tree, configuration, poses);
  VisibleSurface surface;
  surface.render(box, poses, {320, 240, 300.0, 300.0, 159.5, 119.5}, 320, Executor(1));
  return surface;
}

const ArticulatedModel& box_of_20_cm() {
  static const ArticulatedModel box = load_mechanism(
      {R"(<link name="box"><visual><geometry><box size="0.2 0.2 0.2"/></geometry></visual></link>)"},
      {});
  return box;
}

/// First and last column that shows the box in the middle row.
std::pair<int, int> sides(const VisibleSurface& surface) {
  const RenderedDepth& view = surface.view();
  const int row = view.height / 2;
  int first = 0;
  while (view.id[view.index(first, row)] < 0) ++first;
  int last = view.width - 1;
  while (view.id[view.index(last, row)] < 0) --last;
  return {first, last};
}

TEST(VisibleSurface, GoesOnOverFacesAndCreasesAndEndsAtContours) {
  const VisibleSurface surface = seen_box(box_of_20_cm(), 30.0);
  const auto [first, last] = sides(surface);
  const int row = surface.view().height / 2;
  for (int u = first; u + 3 <= last; ++u) EXPECT_TRUE(surface.goes_on(u, row, 4)) << u;
  EXPECT_FALSE(surface.goes_on(first - 2, row, 4));
  EXPECT_FALSE(surface.goes_on(last - 1, row, 4));
}

}  // namespace
}  // namespace lockbox
