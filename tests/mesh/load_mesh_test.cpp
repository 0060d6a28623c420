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

}  // namespace
}  // namespace lockbox
