// SPDX-License-Identifier: BSD-3-Clause
// Bad files are refused with the reason; no message bypasses the exception, nothing crashes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lockbox/core/error.hpp"
#include "lockbox/mesh/load_mesh.hpp"
#include "mesh_files.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class LoadDamagedMesh : public testing::Test {
 protected:
  /// The message of the InputError; stderr has to stay silent.
  std::string refusal(const std::string& name, const std::string& content) {
    return refusal_of(folder_.write(name, content));
  }

  static std::string refusal_of(const std::filesystem::path& file,
                                const Eigen::Vector3d& scale = Eigen::Vector3d::Ones()) {
    testing::internal::CaptureStderr();
    std::string message = "accepted";
    try {
      load_mesh(file, scale);
    } catch (const InputError& error) {
      message = error.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    return message;
  }

  TemporaryFolder folder_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST_F(LoadDamagedMesh, NamesTheFileThatIsMissing) {
  EXPECT_THAT(refusal_of(folder_.path() / "absent.obj"),
              AllOf(HasSubstr("absent.obj"), HasSubstr("exist")));
  EXPECT_THAT(refusal_of(folder_.path()), HasSubstr("not supported"));
  std::filesystem::create_directory(folder_.path() / "folder.obj");
  EXPECT_THAT(refusal_of(folder_.path() / "folder.obj"), HasSubstr("folder"));
}

TEST_F(LoadDamagedMesh, SaysHowToConvertOtherFormats) {
  EXPECT_THAT(refusal("part.dae", "<COLLADA/>"), AllOf(HasSubstr(".dae"), HasSubstr("convert")));
}

TEST_F(LoadDamagedMesh, RefusesEmptyFiles) {
  for (const char* name : {"e.obj", "e.stl", "e.ply"}) {
    EXPECT_THAT(refusal(name, ""), HasSubstr("empty"));
  }
  EXPECT_THAT(refusal("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), HasSubstr("no triangle"));
}

TEST_F(LoadDamagedMesh, RefusesAnIndexWithoutVertexWithItsLine) {
  EXPECT_THAT(refusal("i.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99\n"),
              AllOf(HasSubstr("i.obj:4"), HasSubstr("vertex 99 of 3")));
  EXPECT_THAT(refusal("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n"), HasSubstr("vertex -4"));
  EXPECT_THAT(refusal("z.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"), HasSubstr("vertex 0"));
  EXPECT_THAT(refusal("p.ply", replaced(box_as_text_ply(), "3 0 2 3", "3 0 2 8")),
              HasSubstr("does not exist"));
}

TEST_F(LoadDamagedMesh, RefusesNumbersThatAreNone) {
  EXPECT_THAT(refusal("n.obj", "v 0 nan 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr("n.obj:1"));
  EXPECT_THAT(refusal("w.obj", "v 0 0 0\nv 1 zero 0\n"), HasSubstr("'zero'"));
  EXPECT_THAT(refusal("f.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf a b c\n"), HasSubstr("corner"));
  std::string stl = box_as_binary_stl();
  stl.replace(84 + 12, 4, "\xff\xff\xff\xff");  // a NaN
  EXPECT_THAT(refusal("n.stl", stl), HasSubstr("not finite"));
  EXPECT_THAT(refusal("n.ply", replaced(box_as_text_ply(), "-0.1", "1e999")),
              HasSubstr("n.ply:11"));
}

TEST_F(LoadDamagedMesh, RefusesTruncatedFiles) {
  const auto half = [](const std::string& content) {
    return content.substr(0, content.size() / 2);
  };
  EXPECT_THAT(refusal("t.stl", half(box_as_text_stl())), HasSubstr("t.stl"));
  EXPECT_THAT(refusal("b.stl", half(box_as_binary_stl())), HasSubstr("b.stl"));
  EXPECT_THAT(refusal("t.ply", half(box_as_text_ply())), HasSubstr("t.ply"));
  EXPECT_THAT(refusal("b.ply", half(box_as_binary_ply())), HasSubstr("truncated"));
  EXPECT_THAT(refusal("h.ply", box_as_text_ply().substr(0, 60)), HasSubstr("h.ply"));
}

TEST_F(LoadDamagedMesh, RefusesFilesThatOnlyLookRight) {
  EXPECT_THAT(refusal("x.ply", "solid\n"), HasSubstr("not a PLY"));
  EXPECT_THAT(refusal("x.stl", "ply\n"), HasSubstr("not an STL"));
  EXPECT_THAT(refusal("x.obj", "\x01\x02\x03 garbage \xff"), HasSubstr("no triangle"));
  EXPECT_THAT(
      refusal("cloud.ply", replaced(box_as_text_ply(), "element face 12", "element edge 0")),
      HasSubstr("'face'"));
}

TEST_F(LoadDamagedMesh, RefusesAScaleThatFlattens) {
  const auto file = folder_.write("box.obj", box_as_obj());
  EXPECT_THAT(refusal_of(file, {1.0, 0.0, 1.0}), HasSubstr("scale"));
  EXPECT_THAT(refusal_of(file, {1.0, std::nan(""), 1.0}), HasSubstr("scale"));
}

TEST_F(LoadDamagedMesh, ComparesCountsWithTheFileFirst) {
  std::string stl = box_as_binary_stl();
  stl.replace(82, 1, "\xff");
  EXPECT_THAT(refusal("c.stl", stl), HasSubstr("truncated or garbled"));
  for (const std::string& ply : {box_as_text_ply(), box_as_binary_ply()}) {
    EXPECT_THAT(refusal("v.ply", replaced(ply, "vertex 8", "vertex 4000000000")),
                HasSubstr("more elements than the file has room for"));
    EXPECT_THAT(refusal("f.ply", replaced(ply, "face 12", "face 4000000000")),
                HasSubstr("more elements than the file has room for"));
  }
  std::string list = replaced(box_as_binary_ply(), "uchar int", "uint int");
  EXPECT_THAT(refusal("l.ply", list), HasSubstr("l.ply"));
}

TEST_F(LoadDamagedMesh, RefusesWhatNoObjectHas) {
  EXPECT_THAT(refusal("far.obj", replaced(box_as_obj(), "-0.1", "1e200")), HasSubstr("1000 km"));
  std::string face = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
  for (int i = 0; i < 10'001; ++i) face += " 1";
  EXPECT_THAT(refusal("corners.obj", face), HasSubstr("10000 corners"));
}

TEST_F(LoadDamagedMesh, SaysWhatIsMissing) {
  EXPECT_THAT(refusal("curves.obj", "v 0 0 0\ncstype bspline\nsurf 0 1 0 1 1 2\nend\n"),
              AllOf(HasSubstr("curves.obj:3"), HasSubstr("free-form")));
  EXPECT_THAT(refusal("cloud.obj", "v 0 0 0\nv 1 0 0\nl 1 2\np 1\n"),
              AllOf(HasSubstr("no triangle"), HasSubstr("points")));
  EXPECT_THAT(refusal("comma.obj", "v 0,1 0 0\n"), HasSubstr("point, not with a comma"));
  EXPECT_THAT(refusal("strips.ply", replaced(box_as_text_ply(), "face 12", "tristrips 12")),
              HasSubstr("tristrips"));
}

TEST_F(LoadDamagedMesh, NoticesStlFacetsThatAreNotWhole) {
  const std::string box = box_as_text_stl();
  EXPECT_THAT(refusal("a.stl", replaced(box, "endfacet", "endfacte")), HasSubstr("endfacet"));
  EXPECT_THAT(refusal("b.stl", replaced(box, "facet normal", "fazet normal")),
              HasSubstr("outside of a facet"));
  EXPECT_THAT(refusal("c.stl", replaced(box, "vertex", "vertx")), HasSubstr("2 vertices"));
  EXPECT_THAT(refusal("d.stl", replaced(box, "endsolid", "")), HasSubstr("truncated"));
}

}  // namespace
}  // namespace lockbox
