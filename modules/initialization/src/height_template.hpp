// SPDX-License-Identifier: BSD-3-Clause
// What a model looks like from above one of its flat sides: a map of heights over that side's
// plane, of what joints may change, and of where there is nothing.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/stop_request.hpp"
#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

/// What is expected of a cell: a surface from `low` to `high` metres over the plane, or nothing
/// at the height of `low`, where the model ends.
struct Expectation {
  float low;
  float high;
  bool nothing;

  bool operator==(const Expectation&) const = default;
};

struct TemplateCell {
  float x;  ///< metres, in the plane
  float y;
  int expectation;  ///< of HeightTemplate::expectations
};

struct HeightTemplate {
  int body = 0;                    ///< whose side it is
  Eigen::Isometry3d T_body_plane;  ///< z out of the side; origin in the middle of the cells
  std::vector<Expectation> expectations;
  std::vector<TemplateCell> cells;
  double cell_size = 0.0;  ///< metres
  double radius = 0.0;     ///< metres: no cell is farther from the origin
  double area = 0.0;       ///< of the side, m^2
};

/// The templates of all sides that are large among those that face the same way: seen with the
/// plane in the side itself, and with the plane under the model, where it may touch a table or a
/// wall. They follow from the geometry alone; most significant first. Throws Stopped if that is
/// requested.
std::vector<HeightTemplate> make_height_templates(const KinematicTree& tree,
                                                  const Executor& executor,
                                                  const StopRequest& stop_request);

}  // namespace lockbox
