// SPDX-License-Identifier: BSD-3-Clause
#include "box_wall.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "lockbox/mesh/primitives.hpp"
#include "lockbox/sdf/build_field.hpp"
#include "lockbox/simulation/trajectory.hpp"

namespace lockbox {
namespace {

constexpr int kBoxesAlong = 8;  // each side of the wall
constexpr int kBoxes = kBoxesAlong * kBoxesAlong;
constexpr double kPitch = 0.08;    // metres from box to box
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

Eigen::Vector3d place_of(int box) {
  const int column = box % kBoxesAlong;
  const int row = box / kBoxesAlong;
  return {kPitch * column, kPitch * row, 0.0};
}

/// Consecutive boxes, around the first one's middle.
TriangleMesh stepped_boxes(int count) {
  const double width = kPitch - kGap;
  TriangleMesh mesh;
  for (int box = 0; box < count; ++box) {
    const Eigen::Vector3d place = place_of(box);
    append(make_box({width, width, kDepth}), place, mesh);
    append(make_box({width / 2.0, width / 2.0, kStep}),
           place + Eigen::Vector3d(0.0, 0.0, 0.5 * (kDepth + kStep)), mesh);
  }
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
  const int boxes_of_link = kBoxes / links;
  const TriangleMesh mesh = stepped_boxes(boxes_of_link);
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
      model.tree.joints.push_back(slide(b, place_of(b * boxes_of_link), variables));
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
  // The first box is the base's origin: the wall's centre belongs on the optical axis.
  truth.T_camera_base = truth.T_camera_base * Eigen::Translation3d(-0.5 * place_of(kBoxes - 1));
  for (Eigen::Index v = 0; v < truth.q.size(); ++v) {
    truth.q[v] = 0.01 * static_cast<double>(v % 3);
  }
  return make_scene(std::move(model), {truth}, kPrimeSense);
}

}  // namespace lockbox
