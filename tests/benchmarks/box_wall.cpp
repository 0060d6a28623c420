// SPDX-License-Identifier: BSD-3-Clause
#include "box_wall.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lockbox/mesh/primitives.hpp"
#include "lockbox/sdf/build_field.hpp"
#include "lockbox/simulation/trajectory.hpp"

namespace lockbox {
namespace {

constexpr double kSide = 0.64;     // metres
constexpr double kDepth = 0.06;    // of a box
constexpr double kStep = 0.02;     // that the middle of its front stands out
constexpr double kGap = 0.004;     // between boxes
constexpr double kTravel = 0.05;   // of a joint, either way
constexpr double kSeenFrom = 0.9;  // metres

void append(const TriangleMesh& part, const Eigen::Vector3d& offset, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Eigen::Vector3d& vertex : part.vertices) {
    mesh.vertices.push_back(vertex + offset);
  }
  for (const auto& [a, b, c] : part.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
  }
}

TriangleMesh stepped_box(double width, double height) {
  TriangleMesh mesh;
  append(make_box({width - kGap, height - kGap, kDepth}), Eigen::Vector3d::Zero(), mesh);
  append(make_box({width / 2.0, height / 2.0, kStep}), {0.0, 0.0, 0.5 * (kDepth + kStep)}, mesh);
  return mesh;
}

Joint slide(int body, const Eigen::Vector3d& offset, int variables) {
  Joint joint;
  joint.name = "slide_" + std::to_string(body);
  joint.type = JointType::prismatic;
  joint.child_body = body;
  joint.T_parent_joint.translation() = offset;
  joint.lower = -kTravel;
  joint.upper = kTravel;
  joint.variable = std::min(body, variables) - 1;
  joint.is_mimic = body > variables;
  return joint;
}

}  // namespace

ArticulatedModel box_wall(int links, int variables) {
  const int columns = static_cast<int>(std::ceil(std::sqrt(links)));
  const int rows = links / columns + (links % columns == 0 ? 0 : 1);
  const double width = kSide / columns;
  const double height = kSide / rows;
  const TriangleMesh mesh = stepped_box(width, height);
  ArticulatedModel model;
  model.tree.name = "box_wall";
  for (int b = 0; b < links; ++b) {
    Body body;
    body.name = "box_" + std::to_string(b);
    body.links = {body.name};
    body.mesh = mesh;
    body.parent_joint = b - 1;
    model.tree.bodies.push_back(std::move(body));
    model.fields.emplace_back(build_field(mesh, FieldOptions{}, Executor()));
    if (b > 0) {
      const int column = b % columns;
      const int row = b / columns;
      model.tree.joints.push_back(slide(b, {column * width, row * height, 0.0}, variables));
      model.tree.file_order.push_back(b - 1);
      if (b <= variables) {
        model.tree.variable_joint.push_back(b - 1);
      }
    }
  }
  return model;
}

RegistrationScene box_wall_scene(int links, int variables) {
  ArticulatedModel model = box_wall(links, variables);
  Configuration truth = rest_configuration(model.tree);
  truth.T_camera_base = facing_pose(kSeenFrom);
  // The first box is the base: the wall's centre belongs on the optical axis.
  const Eigen::Vector3d last =
      links > 1 ? Eigen::Vector3d(model.tree.joints.back().T_parent_joint.translation())
                : Eigen::Vector3d::Zero();
  truth.T_camera_base = truth.T_camera_base * Eigen::Translation3d(-0.5 * last);
  for (Eigen::Index v = 0; v < truth.q.size(); ++v) {
    truth.q[v] = 0.01 * static_cast<double>(v % 3);
  }
  return make_scene(std::move(model), {truth}, kPrimeSense);
}

}  // namespace lockbox
