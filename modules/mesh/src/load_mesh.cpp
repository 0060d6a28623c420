// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/load_mesh.hpp"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkPolygon.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "file_checks.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/mesh/repair.hpp"
#include "tokens.hpp"

namespace lockbox {
namespace {

std::string read_content(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw InputError(file.string(), "is a folder, not a mesh");
  }
  std::ifstream stream(file, std::ios::binary);
  std::string content((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!stream.is_open() || stream.bad()) {
    throw InputError(file.string(), "the mesh cannot be read; does the file exist?");
  }
  if (content.empty()) {
    throw InputError(file.string(), "the mesh is empty");
  }
  return content;
}

/// Appends what VTK reports to the std::string behind client_data, instead of stderr.
void collect_message(vtkObject*, unsigned long, void* client_data, void* call_data) {
  auto& messages = *static_cast<std::string*>(client_data);
  messages += call_data != nullptr ? static_cast<const char*>(call_data) : "";
}

template <typename Reader>
vtkSmartPointer<vtkPolyData> read_with(Reader& reader, const std::filesystem::path& file) {
  std::string messages;
  vtkNew<vtkCallbackCommand> collect;
  collect->SetCallback(collect_message);
  collect->SetClientData(&messages);
  reader.AddObserver(vtkCommand::ErrorEvent, collect);
  reader.AddObserver(vtkCommand::WarningEvent, collect);
  reader.SetFileName(file.c_str());
  reader.Update();
  if (!messages.empty()) {
    std::replace(messages.begin(), messages.end(), '\n', ' ');
    throw InputError(file.string(), "the mesh cannot be read: " + messages);
  }
  return reader.GetOutput();
}

struct Polygons {
  vtkSmartPointer<vtkPolyData> data;
  std::size_t expected;  ///< how many the file holds
};

Polygons read_polygons(const std::filesystem::path& file) {
  std::string format = file.extension().string();
  std::transform(format.begin(), format.end(), format.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (format == ".obj") {
    const std::size_t expected = check_obj(file, read_content(file));
    return {read_with(*vtkNew<vtkOBJReader>(), file), expected};
  }
  if (format == ".stl") {
    const std::size_t expected = check_stl(file, read_content(file));
    vtkNew<vtkSTLReader> reader;
    reader->MergingOff();
    return {read_with(*reader, file), expected};
  }
  if (format == ".ply") {
    const std::size_t expected = check_ply(file, read_content(file));
    return {read_with(*vtkNew<vtkPLYReader>(), file), expected};
  }
  throw InputError(file.string(), in_quotes(format) +
                                      " meshes are not supported; convert it to .obj, .stl or "
                                      ".ply, for instance with Blender");
}

void append_polygon(vtkIdType size, const vtkIdType* corners, vtkPolygon& polygon,
                    vtkPoints& points, TriangleMesh& mesh) {
  if (size < 3) {
    return;
  }
  const auto vertex = [&](vtkIdType i) { return static_cast<std::uint32_t>(corners[i]); };
  if (size == 3) {
    mesh.triangles.push_back({vertex(0), vertex(1), vertex(2)});
    return;
  }
  polygon.Initialize(static_cast<int>(size), corners, &points);
  vtkNew<vtkIdList> cut;
  if (polygon.Triangulate(cut) == 0) {
    // A polygon without area, or one that crosses itself: welding drops the former.
    for (vtkIdType i = 2; i < size; ++i) {
      mesh.triangles.push_back({vertex(0), vertex(i - 1), vertex(i)});
    }
    return;
  }
  for (vtkIdType i = 0; i + 2 < cut->GetNumberOfIds(); i += 3) {
    mesh.triangles.push_back(
        {vertex(cut->GetId(i)), vertex(cut->GetId(i + 1)), vertex(cut->GetId(i + 2))});
  }
}

TriangleMesh triangulated(const Polygons& polygons, const std::string& file) {
  vtkPolyData& data = *polygons.data;
  if (static_cast<std::size_t>(data.GetNumberOfPolys()) != polygons.expected) {
    throw InputError(file, "only " + std::to_string(data.GetNumberOfPolys()) + " of " +
                               std::to_string(polygons.expected) +
                               " faces can be read; write all corners in the same style");
  }
  TriangleMesh mesh;
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    mesh.vertices.emplace_back(data.GetPoint(i));
    if (!mesh.vertices.back().allFinite()) {
      throw InputError(file, "vertex " + std::to_string(i + 1) + " is not finite");
    }
  }
  vtkNew<vtkPolygon> polygon;
  vtkCellArray& cells = *data.GetPolys();
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  for (cells.InitTraversal(); cells.GetNextCell(size, corners) != 0;) {
    if (std::any_of(corners, corners + size, [&](vtkIdType corner) {
          return corner < 0 || corner >= data.GetNumberOfPoints();
        })) {
      throw InputError(file, "a face refers to a vertex that does not exist");
    }
    append_polygon(size, corners, *polygon, *data.GetPoints(), mesh);
  }
  return mesh;
}

void apply_scale(TriangleMesh& mesh, const Eigen::Vector3d& scale) {
  for (Eigen::Vector3d& vertex : mesh.vertices) {
    vertex = vertex.cwiseProduct(scale);
  }
  if (scale.prod() < 0.0) {
    for (auto& triangle : mesh.triangles) {
      std::swap(triangle[1], triangle[2]);
    }
  }
}

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& file, const Eigen::Vector3d& scale) {
  if (!scale.allFinite() || (scale.array() == 0.0).any()) {
    throw InputError(file.string(), "the mesh's scale has a zero or is not finite");
  }
  TriangleMesh mesh = triangulated(read_polygons(file), file.string());
  apply_scale(mesh, scale);
  mesh = welded(mesh);
  if (mesh.triangles.empty()) {
    throw InputError(file.string(), "the mesh has no triangle with an area");
  }
  return mesh;
}

}  // namespace lockbox
