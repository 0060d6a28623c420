// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "lockbox/core/error.hpp"
#include "mesh_readers.hpp"
#include "ply_body.hpp"

namespace lockbox {
namespace {

bool is_vertex_list(const PlyProperty& property) {
  return property.count_type &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// 0, 1 or 2 for x, y and z; -1 for anything else.
int axis_of(const PlyProperty& property) {
  const bool is_axis = !property.count_type && property.name.size() == 1;
  const std::size_t axis =
      is_axis ? std::string_view("xyz").find(property.name) : std::string::npos;
  return axis == std::string_view::npos ? -1 : static_cast<int>(axis);
}

/// Throws InputError unless each coordinate and the list of corners are there once.
void require_geometry(const PlyHeader& header, const std::string& file) {
  const auto& vertex = header.only("vertex", file).properties;
  for (int axis = 0; axis < 3; ++axis) {
    const auto is_axis = [&](const PlyProperty& property) { return axis_of(property) == axis; };
    if (std::count_if(vertex.begin(), vertex.end(), is_axis) != 1) {
      throw InputError(file, "the vertices need one property each of 'x', 'y' and 'z'");
    }
  }
  const auto& face = header.only("face", file).properties;
  if (std::count_if(face.begin(), face.end(), is_vertex_list) != 1) {
    throw InputError(file, "the faces need one list 'vertex_indices'");
  }
}

/// Reads the elements of a body in either encoding.
template <typename Body>
class PlyElements {
 public:
  PlyElements(const std::string& file, const PlyHeader& header)
      : header_(header),
        vertices_(header.only("vertex", file).count),
        body_(file, header),
        soup_(file) {}

  PolygonSoup read() {
    require_room();
    for (const PlyElement& element : header_.elements) {
      // What has no properties has nothing in the body.
      for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
        body_.begin_element();
        if (element.name == "vertex") {
          vertex(element);
        } else {
          face_or_other(element);
        }
      }
    }
    return std::move(soup_);
  }

 private:
  /// Counts are compared with the file's size before anything is made of them.
  void require_room() const {
    double bytes = 0.0;
    for (const PlyElement& element : header_.elements) {
      bytes += static_cast<double>(element.count) * static_cast<double>(Body::least_bytes(element));
    }
    // The last word of a text needs no blank behind it.
    if (bytes > static_cast<double>(header_.body.size()) + 1.0) {
      throw InputError(soup_.file(),
                       "its header says more elements than the file has room for: it is truncated "
                       "or garbled");
    }
  }

  void vertex(const PlyElement& element) {
    Eigen::Vector3d position;
    for (const PlyProperty& property : element.properties) {
      const int axis = axis_of(property);
      if (axis >= 0) {
        position[axis] = body_.value(property.type);
      } else {
        skip(property);
      }
    }
    if (!position.allFinite()) {
      body_.refuse("vertex " + std::to_string(soup_.vertices().size()) + " is not finite");
    }
    soup_.add_vertex(position);
  }

  void face_or_other(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (element.name == "face" && is_vertex_list(property)) {
        corners(property);
      } else {
        skip(property);
      }
    }
  }

  void skip(const PlyProperty& property) {
    body_.skip(property.type, property.count_type ? list_length(property) : 1);
  }

  void corners(const PlyProperty& property) {
    for (std::size_t left = list_length(property); left > 0; --left) {
      const double index = body_.value(property.type);
      if (!(index >= 0.0 && index < static_cast<double>(vertices_) && index == std::floor(index))) {
        body_.refuse("a face refers to a vertex that does not exist");
      }
      soup_.add_corner(static_cast<std::uint32_t>(index));
    }
    soup_.end_face();
  }

  std::size_t list_length(const PlyProperty& property) {
    const double length = body_.value(*property.count_type);
    if (!(length >= 0.0 && length <= UINT32_MAX && length == std::floor(length))) {
      body_.refuse("a list has a length that is none");
    }
    return static_cast<std::size_t>(length);
  }

  const PlyHeader& header_;
  std::size_t vertices_;
  Body body_;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_ply(const std::filesystem::path& file, std::string_view content) {
  const std::string name = file.string();
  const PlyHeader header = read_ply_header(name, content);
  require_geometry(header, name);
  return header.binary ? PlyElements<BinaryPlyBody>(name, header).read()
                       : PlyElements<TextPlyBody>(name, header).read();
}

}  // namespace lockbox
