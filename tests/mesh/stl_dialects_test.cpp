// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>

#include "dialects.hpp"
#include "mesh_files.hpp"

namespace lockbox {
namespace {

TEST(StlDialects, LineEndsBlanksAndComments) {
  const std::string box = box_as_text_stl();
  expect_box("crlf.stl", all_replaced(box, "\n", "\r\n"));
  expect_box("cr.stl", all_replaced(box, "\n", "\r"));
  expect_box("bom.stl", "\xEF\xBB\xBF" + box);
  expect_box("tabs.stl", "\n\t" + all_replaced(box, " ", "\t "));
  expect_box("one_line.stl", "solid\n" + all_replaced(box.substr(10), "\n", " "));
  expect_box("comments.stl", all_replaced(box, "endloop\n", "endloop # words\n; more\n"));
  std::string capitals = box;
  std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  expect_box("capitals.stl", capitals);
}

TEST(StlDialects, NamesAndWordsInTwo) {
  const std::string box = box_as_text_stl();
  expect_box("end.stl", all_replaced(box, "endsolid box", "end solid"));
  expect_box("ends.stl",
             all_replaced(all_replaced(box, "endfacet", "end facet"), "endloop", "end loop"));
  expect_box("name.stl", all_replaced(box, "solid box", "solid vertex facet end solid"));
  expect_box("words.stl", all_replaced(box, "endsolid box", "endsolid two words\n\nand a note"));
  expect_box("none.stl", all_replaced(box, "solid box", "solid"));
}

TEST(StlDialects, NormalsAreNotUsed) {
  const std::string box = box_as_text_stl();
  expect_box("nan.stl", all_replaced(box, "normal 0 0 0", "normal nan -nan(ind) inf"));
  expect_box("none.stl", all_replaced(box, " normal 0 0 0", ""));
  std::string binary = box_as_binary_stl();
  binary.replace(84, 4, "\xff\xff\xff\xff");  // a NaN
  binary.replace(84 + 48, 2, "\x12\x34");     // a colour
  expect_box("nan_too.stl", binary);
}

TEST(StlDialects, SeveralSolidsAreOneMesh) {
  const std::string box = box_as_text_stl();
  const std::size_t half = box.find(" facet", box.size() / 2);
  expect_box("two.stl", box.substr(0, half) + "endsolid box\nsolid rest\n" + box.substr(half));
}

TEST(StlDialects, BinaryFilesByWhatTheyHold) {
  std::string box = box_as_binary_stl();  // whose header begins with "solid"
  expect_box("trailing.stl", box + "appended by the program that wrote it");
  expect_box("trailing_zero.stl", box + '\0');
  box.replace(0, 80, std::string(80, '\0'));
  expect_box("zeros.stl", box);
  box.replace(0, 80, std::string(80, '\n'));
  expect_box("lines.stl", box);
}

}  // namespace
}  // namespace lockbox
