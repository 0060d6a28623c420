// SPDX-License-Identifier: BSD-3-Clause
#include "dialects.hpp"
#include "mesh_files.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

/// Each corner of a face with this behind its vertex.
std::string with_corners(const std::string& behind) {
  std::string text = box_as_obj();
  for (std::size_t at = text.find("f "); at != std::string::npos; at = text.find("f ", at + 1)) {
    for (int corner = 0; corner < 3; ++corner) {
      at = text.find_first_of(" \n", text.find(' ', at) + 1);
      text.insert(at, behind);
    }
  }
  return text;
}

TEST(ObjDialects, LineEndsBlanksAndComments) {
  const std::string box = box_as_obj();
  expect_box("crlf.obj", all_replaced(box, "\n", "\r\n"));
  expect_box("cr.obj", all_replaced(box, "\n", "\r"));
  expect_box("bom.obj", "\xEF\xBB\xBF" + box);
  expect_box("tabs.obj", all_replaced(box, " ", "\t "));
  expect_box("comments.obj", all_replaced(box, "\n", " # words 1 2 \\\n"));
  expect_box("unended.obj", box.substr(0, box.size() - 1));
}

TEST(ObjDialects, StatementsThatGoOnInTheNextLine) {
  const std::string box = box_as_obj();
  std::string faces = box;
  for (std::size_t at = box.rfind(' '); at > box.find("f "); at = box.rfind(' ', at - 1)) {
    faces.insert(at, at % 2 == 0 ? " \\\n" : "\\\r\n");
  }
  expect_box("faces.obj", faces);
  expect_box("vertices.obj", all_replaced(box, "v ", "v \\\n"));
  expect_box("names.obj", "g the \\\n part\nvn 0 \\\n 0 1\nmtllib C:\\parts\\\n" + box);
}

TEST(ObjDialects, WhatIsNotUsedIsNotLookedAt) {
  const std::string box = box_as_obj();
  for (const char* behind : {"/1", "//1", "/1/1", "/99/99", "//-7", "/", "//", "/x/nan"}) {
    expect_box("corners.obj", with_corners(behind));
  }
  expect_box("nan.obj", "vn nan nan nan\nvn -nan(ind) 1\nvt\nvt 1.#QNAN\nvp 1\n" + box);
  expect_box("mtl.obj", "mtllib missing.mtl\nusemtl none\ns off\ns 1\no a b\ng\n" + box);
  expect_box("lines.obj", "l 1 2\np 1\ncurv 0 1 1 2\ncstype bspline\nunknown 1 2\n" + box);
  expect_box("colours.obj", all_replaced(box, "\nv ", " 1 0.5 nan\nv "));
}

TEST(ObjDialects, CornersOfSeveralStylesInOneFile) {
  std::string text = "vt 0 0\nvn 0 0 1\n" + box_as_obj();
  std::size_t at = 0;
  for (const char* behind : {"/1", "//1", "/1/1"}) {
    at = text.find_first_of(" \n", text.find("f ", at + 1) + 2);
    text.insert(at, behind);
  }
  expect_box("mixed.obj", text);
}

TEST(ObjDialects, VerticesBehindTheirFacesAndNegativeIndices) {
  const std::string box = box_as_obj();
  const std::size_t faces = box.find("f ");
  expect_box("late.obj", box.substr(faces) + box.substr(0, faces));
  expect_box("late_name.obj", box.substr(faces) + "o end\n" + box.substr(0, faces));
  std::string negative = box.substr(0, faces);
  for (std::size_t i = faces; i < box.size(); ++i) {
    const bool is_index = box[i] >= '1' && box[i] <= '8';
    negative += is_index ? std::to_string(box[i] - '1' - 8) : std::string(1, box[i]);
  }
  expect_box("negative.obj", negative);
}

TEST(ObjDialects, FacesWithoutAreaAreDropped) {
  expect_box("flat.obj", box_as_obj() + "f 1\nf 1 2\nf 1 1 2\nf 3 3 3 3\nf\n");
}

TEST(ObjDialects, FacesForBothSides) {
  const std::string box = box_as_obj();
  std::string both = box;
  for (std::size_t at = box.find("f "); at != std::string::npos; at = box.find("f ", at + 1)) {
    const std::string face = box.substr(at + 2, box.find('\n', at) - at - 2);
    both += "f " + std::string(face.rbegin(), face.rend()) + "\n";
  }
  expect_box("both.obj", both);
}

// An L-shaped prism: two concave hexagons and six quadrilaterals, 1 m high, area 3 m^2.
constexpr const char* kPrism =
    "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n"
    "v 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\n"
    "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n"
    "f 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n";

TEST(ObjDialects, PolygonsConcaveOnesToo) {
  expect_box("l.obj", kPrism, 3.0);
  TemporaryFolder folder;
  EXPECT_NEAR(surface_area(load_mesh(folder.write("l.obj", kPrism))), 14.0, 1e-9);
}

TEST(ObjDialects, PolygonsForBothSidesFromAnyCorner) {
  expect_box("l.obj",
             std::string(kPrism) +
                 "f 3 4 5 6 1 2\nf 12 11 10 9 8 7\n"
                 "f 2 1 7 8\nf 2 8 9 3\nf 10 4 3 9\nf 4 10 11 5\nf 12 6 5 11\nf 1 6 12 7\n",
             3.0);
}

}  // namespace
}  // namespace lockbox
