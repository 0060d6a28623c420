// SPDX-License-Identifier: BSD-3-Clause
// Bad files are refused with the reason; no message bypasses the exception, nothing crashes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

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
  EXPECT_THAT(refusal("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/7 3/1\n"),
              HasSubstr("texture coordinate 7 of 1"));
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

TEST_F(LoadDamagedMesh, SurvivesRandomDamage) {
  const std::vector<std::pair<std::string, std::string>> files = {{"d.obj", box_as_obj()},
                                                                  {"d.stl", box_as_text_stl()},
                                                                  {"e.stl", box_as_binary_stl()},
                                                                  {"d.ply", box_as_text_ply()},
                                                                  {"e.ply", box_as_binary_ply()}};
  std::mt19937 random(5);
  for (int round = 0; round < 30; ++round) {
    for (const auto& [name, content] : files) {
      std::string damaged = content;
      for (int i = 0; i < 3; ++i) {
        damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
      }
      if (round % 3 == 0) {
        damaged.resize(random() % damaged.size());
      }
      const std::string message = refusal(name, damaged);
      EXPECT_TRUE(message == "accepted" || message.find(name) != std::string::npos) << message;
    }
  }
}

}  // namespace
}  // namespace lockbox
