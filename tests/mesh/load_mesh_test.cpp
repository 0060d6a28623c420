// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/load_mesh.hpp"

#include <gtest/gtest.h>

#include "lockbox/mesh/mesh_audit.hpp"
#include "mesh_files.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

struct Format {
  const char* name;
  std::string (*content)();
};

class LoadMesh : public testing::TestWithParam<Format> {
 protected:
  TemporaryFolder folder_;
};

TEST_P(LoadMesh, ReadsABoxAsOneClosedShell) {
  const auto file = folder_.write(GetParam().name, GetParam().content());
  const TriangleMesh mesh = load_mesh(file);
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.triangles.size(), 12U);
  const MeshAudit report = audit(mesh);
  EXPECT_TRUE(report.is_closed());
  EXPECT_NEAR(report.volume, 0.001, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Formats, LoadMesh,
                         testing::Values(Format{"box.obj", box_as_obj},
                                         Format{"text.stl", box_as_text_stl},
                                         Format{"BINARY.STL", box_as_binary_stl},
                                         Format{"text.ply", box_as_text_ply},
                                         Format{"binary.ply", box_as_binary_ply}));

TEST(LoadMeshScale, AppliesAxisByAxis) {
  TemporaryFolder folder;
  const TriangleMesh mesh = load_mesh(folder.write("box.obj", box_as_obj()), {1e-3, 2.0, 3.0});
  EXPECT_TRUE(bounds(mesh).sizes().isApprox(Eigen::Vector3d(2e-4, 0.2, 0.15), 1e-6));
}

TEST(LoadMeshScale, MirroringKeepsOutsideOutside) {
  TemporaryFolder folder;
  const auto file = folder.write("box.obj", box_as_obj());
  EXPECT_NEAR(signed_volume(load_mesh(file, {-1.0, 1.0, 1.0})), 0.001, 1e-9);
  EXPECT_NEAR(signed_volume(load_mesh(file, {-1.0, -1.0, 1.0})), 0.001, 1e-9);
}

TEST(LoadObj, CutsPolygonsConcaveOnesToo) {
  // An L-shaped prism: two concave hexagons and six quadrilaterals, 1 m high, area 3 m^2.
  TemporaryFolder folder;
  const auto file = folder.write("l.obj",
                                 "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n"
                                 "v 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\n"
                                 "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n"
                                 "f 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\n"
                                 "f 5 6 12 11\nf 6 1 7 12\n");
  const MeshAudit report = audit(load_mesh(file));
  EXPECT_TRUE(report.is_closed());
  EXPECT_NEAR(report.volume, 3.0, 1e-6);
  EXPECT_NEAR(report.area, 14.0, 1e-6);
}

TEST(LoadObj, ReadsTextureNormalsAndRelativeIndices) {
  TemporaryFolder folder;
  const auto file =
      folder.write("t.obj",
                   "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\r\n"
                   "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nusemtl red\ns off\n"
                   "f 1/1/1 3/2/1 2/3/1\nf 1/1/1 2/2/1 4/3/1\nf -4/1/1 -1/2/1 -2/3/1\n"
                   "f 2/1/1 3/2/1 4/3/1\n");
  const MeshAudit report = audit(load_mesh(file));
  EXPECT_TRUE(report.is_closed());
  EXPECT_NEAR(report.volume, 1.0 / 6.0, 1e-6);
}

}  // namespace
}  // namespace lockbox
