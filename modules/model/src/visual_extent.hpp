// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace lockbox {

/// How large a visual is and where it lies: what its unit is concluded from.
struct VisualExtent {
  std::string link;
  std::string shape;                                ///< mesh, box, sphere, cylinder
  std::string file;                                 ///< of a mesh, as the model names it
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< of a mesh, as the model gives it
  int body = 0;                                     ///< in the order that the file has them
  Eigen::AlignedBox3d box;                          ///< in the frame of the body, metres

  double size() const { return box.sizes().maxCoeff(); }
  double distance() const { return box.center().norm(); }
};

}  // namespace lockbox
