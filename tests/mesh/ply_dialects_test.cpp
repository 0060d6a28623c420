// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <sstream>

#include "dialects.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "mesh_files.hpp"

namespace lockbox {
namespace {

enum class Encoding { text, little_endian, big_endian };

/// Writes a PLY file value by value.
class PlyWriter {
 public:
  explicit PlyWriter(Encoding encoding) : encoding_(encoding) {
    constexpr std::array<const char*, 3> kNames = {"ascii", "binary_little_endian",
                                                   "binary_big_endian"};
    content_ = std::string("ply\nformat ") + kNames[static_cast<std::size_t>(encoding)] + " 1.0\n";
  }

  void line(const std::string& text) { content_ += text + "\n"; }

  void put(const std::string& type, double value) {
    if (encoding_ == Encoding::text) {
      std::ostringstream text;
      text << value << ' ';
      content_ += text.str();
    } else if (type.ends_with("char") || type.ends_with("int8")) {
      put_binary(static_cast<std::int8_t>(value));
    } else if (type.ends_with("short") || type.ends_with("int16")) {
      put_binary(static_cast<std::int16_t>(value));
    } else if (type.ends_with("int") || type.ends_with("int32")) {
      put_binary(static_cast<std::int32_t>(value));
    } else if (type == "double" || type == "float64") {
      put_binary(value);
    } else {
      put_binary(static_cast<float>(value));
    }
  }

  void end_element() { content_ += encoding_ == Encoding::text ? "\n" : ""; }

  const std::string& content() const { return content_; }

 private:
  template <typename T>
  void put_binary(T value) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    if (encoding_ == Encoding::big_endian) std::reverse(bytes.begin(), bytes.end());
    content_ += bytes;
  }

  Encoding encoding_;
  std::string content_;
};

/// What of a file is to be unusual.
struct Style {
  Encoding encoding = Encoding::text;
  std::string number = "float";
  std::string count = "uchar";
  std::string index = "int";
  bool faces_first = false;
  bool extra = false;  ///< elements and properties that a link has no use for
};

void put_vertices(PlyWriter& ply, const Style& style, const TriangleMesh& box) {
  for (const Eigen::Vector3d& vertex : box.vertices) {
    if (style.extra) ply.put("uchar", 7);
    ply.put(style.number, vertex.z());
    ply.put(style.number, vertex.x());
    if (style.extra) {
      ply.put("uchar", 2);
      ply.put("double", 0.5);
      ply.put("double", 1e300);
    }
    ply.put(style.number, vertex.y());
    ply.end_element();
  }
}

void put_faces(PlyWriter& ply, const Style& style, const TriangleMesh& box) {
  for (const auto& triangle : box.triangles) {
    if (style.extra) {
      ply.put("short", 2);
      ply.put("float", 0.0);
      ply.put("float", 1.0);
    }
    ply.put(style.count, 3);
    for (const std::uint32_t vertex : triangle) ply.put(style.index, vertex);
    if (style.extra) ply.put("int8", -1);
    ply.end_element();
  }
}

std::string box_as_ply(const Style& style) {
  const TriangleMesh box = make_box({0.2, 0.1, 0.05});
  PlyWriter ply(style.encoding);
  const std::string number = "property " + style.number + " ";
  if (style.extra) ply.line("element camera 1\nproperty list int double x\nproperty double y");
  const auto say_vertices = [&] {
    ply.line("element vertex 8");
    if (style.extra) ply.line("property uchar z_flag");
    ply.line(number + "z\n" + number + "x");
    if (style.extra) ply.line("property list uchar double weights");
    ply.line(number + "y");
  };
  if (!style.faces_first) say_vertices();
  ply.line("element face 12");
  if (style.extra) ply.line("property list short float texcoord");
  ply.line("property list " + style.count + " " + style.index + " vertex_index");
  if (style.extra) ply.line("property int8 flags");
  if (style.faces_first) say_vertices();
  if (style.extra) ply.line("element nothing 1000000000\nelement edge 1\nproperty int vertex1");
  ply.line("end_header");
  if (style.extra) {
    for (const double value : {2.0, 8.5, 9.5, 0.25})
      ply.put(value == 2.0 ? "int" : "double", value);
    ply.end_element();
  }
  if (!style.faces_first) put_vertices(ply, style, box);
  put_faces(ply, style, box);
  if (style.faces_first) put_vertices(ply, style, box);
  if (style.extra) ply.put("int", 3);
  return ply.content();
}

class PlyDialects : public testing::TestWithParam<Encoding> {};

TEST_P(PlyDialects, ElementsAndPropertiesInAnyOrder) {
  for (const bool faces_first : {false, true}) {
    for (const bool extra : {false, true}) {
      Style style{GetParam()};
      style.faces_first = faces_first;
      style.extra = extra;
      SCOPED_TRACE(testing::Message() << "faces first " << faces_first << ", extra " << extra);
      expect_box("order.ply", box_as_ply(style));
    }
  }
}

TEST_P(PlyDialects, NumbersOfAllTypes) {
  for (const char* type :
       {"char", "uchar", "int8", "uint8", "short", "ushort", "int16", "uint16", "int", "uint",
        "int32", "uint32", "float", "float32", "double", "float64"}) {
    SCOPED_TRACE(type);
    Style style{GetParam()};
    style.count = type;
    style.index = type;
    style.number = std::string(type).find("64") == std::string::npos ? "float" : type;
    expect_box("types.ply", box_as_ply(style));
  }
}

INSTANTIATE_TEST_SUITE_P(Encodings, PlyDialects,
                         testing::Values(Encoding::text, Encoding::little_endian,
                                         Encoding::big_endian));

TEST(PlyHeaders, LineEndsBlanksAndComments) {
  const std::string text = box_as_text_ply();
  expect_box("crlf.ply", all_replaced(text, "\n", "\r\n"));
  expect_box("cr.ply", all_replaced(text, "\n", "\r"));
  expect_box("bom.ply", "\xEF\xBB\xBF" + text);
  expect_box("tabs.ply", all_replaced(text, " ", "\t "));
  expect_box("comments.ply",
             all_replaced(text, "element", "comment # \f element\nobj_info\n\nelement"));
  const std::string binary = box_as_binary_ply();
  const std::size_t body = binary.find("end_header\n") + 11;
  const std::string header = binary.substr(0, body);
  expect_box("crlf_binary.ply", all_replaced(header, "\n", "\r\n") + binary.substr(body));
  expect_box("cr_binary.ply", all_replaced(header, "\n", "\r") + binary.substr(body));
  expect_box("form_feed.ply",
             all_replaced(header, "end_header", "end_header\f") + binary.substr(body));
}

TEST(PlyHeaders, TheFirstByteOfABodyIsNoLineEnd) {
  // A list of ten indices, whose length is the byte of a line feed, behind a header of CRs.
  std::string content =
      "ply\rformat binary_little_endian 1.0\relement tag 1\rproperty list uchar char numbers\r"
      "element vertex 8\rproperty float x\rproperty float y\rproperty float z\r"
      "element face 12\rproperty list uchar int vertex_indices\rend_header\r";
  content += "\n0123456789";
  const std::string box = box_as_binary_ply();
  expect_box("cr.ply", content + box.substr(box.find("end_header\n") + 11));
}

TEST(PlyBodies, NumbersOverSeveralLines) {
  std::string text = box_as_text_ply();
  const std::size_t body = text.find("end_header\n") + 11;
  expect_box("wrapped.ply", text.substr(0, body) + all_replaced(text.substr(body), " ", "\n"));
  expect_box("trailing.ply", text + "\nwhat a program appended");
  // What is no coordinate may be anything.
  text = all_replaced(text, "property float z\n", "property float z\nproperty float nx\n");
  std::size_t at = text.find("end_header\n") + 11;
  for (int vertex = 0; vertex < 8; ++vertex) {
    at = text.find('\n', at) + 5;
    text.insert(at - 5, " nan");
  }
  expect_box("normals.ply", text);
}

}  // namespace
}  // namespace lockbox
