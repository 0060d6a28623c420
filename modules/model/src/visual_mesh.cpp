// SPDX-License-Identifier: BSD-3-Clause
#include "visual_mesh.hpp"

#include "lockbox/mesh/load_mesh.hpp"
#include "lockbox/mesh/primitives.hpp"

namespace lockbox {
namespace {

Eigen::Vector3d vector(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}

TriangleMesh geometry_mesh(const urdf::Geometry& geometry, const MeshLocator& locator,
                           double mesh_scale) {
  switch (geometry.type) {
    case urdf::Geometry::BOX:
      return make_box(vector(static_cast<const urdf::Box&>(geometry).dim));
    case urdf::Geometry::SPHERE:
      return make_sphere(static_cast<const urdf::Sphere&>(geometry).radius);
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      return make_cylinder(cylinder.radius, cylinder.length);
    }
    default: {
      const auto& mesh = static_cast<const urdf::Mesh&>(geometry);
      return load_mesh(locator.locate(mesh.filename), mesh_scale * vector(mesh.scale));
    }
  }
}

}  // namespace

Eigen::Isometry3d isometry(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).toRotationMatrix();
  T.translation() = vector(pose.position);
  return T;
}

ColoredMesh visual_mesh(const urdf::Visual& visual, const MeshLocator& locator, double mesh_scale) {
  ColoredMesh result;
  result.mesh =
      transformed(geometry_mesh(*visual.geometry, locator, mesh_scale), isometry(visual.origin));
  if (visual.material) {
    const urdf::Color& color = visual.material->color;
    result.rgba = {color.r, color.g, color.b, color.a};
  }
  return result;
}

VisualExtent described(const urdf::Geometry& geometry) {
  VisualExtent extent;
  switch (geometry.type) {
    case urdf::Geometry::BOX:
      extent.shape = "box";
      break;
    case urdf::Geometry::SPHERE:
      extent.shape = "sphere";
      break;
    case urdf::Geometry::CYLINDER:
      extent.shape = "cylinder";
      break;
    default: {
      const auto& mesh = static_cast<const urdf::Mesh&>(geometry);
      extent.shape = "mesh";
      extent.file = mesh.filename;
      extent.scale = vector(mesh.scale);
    }
  }
  return extent;
}

}  // namespace lockbox
