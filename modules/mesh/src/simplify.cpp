// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/simplify.hpp"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkSmartPointer.h>

namespace lockbox {
namespace {

vtkSmartPointer<vtkPolyData> to_poly_data(const TriangleMesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Eigen::Vector3d& vertex : mesh.vertices) points->InsertNextPoint(vertex.data());
  vtkNew<vtkCellArray> triangles;
  for (const auto& [a, b, c] : mesh.triangles) triangles->InsertNextCell({a, b, c});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  return data;
}

TriangleMesh to_mesh(vtkPolyData& data) {
  TriangleMesh mesh;
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    mesh.vertices.push_back(Eigen::Map<const Eigen::Vector3d>(data.GetPoint(i)));
  }
  const auto cell = vtk::TakeSmartPointer(data.GetPolys()->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell()) {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    cell->GetCurrentCell(size, corners);
    mesh.triangles.push_back({static_cast<std::uint32_t>(corners[0]),
                              static_cast<std::uint32_t>(corners[1]),
                              static_cast<std::uint32_t>(corners[2])});
  }
  return mesh;
}

}  // namespace

TriangleMesh simplified(const TriangleMesh& mesh, std::size_t most_triangles) {
  if (mesh.triangles.size() <= most_triangles) return mesh;
  vtkNew<vtkQuadricDecimation> decimation;
  decimation->SetInputData(to_poly_data(mesh));
  decimation->SetTargetReduction(1.0 - static_cast<double>(most_triangles) /
                                           static_cast<double>(mesh.triangles.size()));
  decimation->VolumePreservationOn();
  decimation->Update();
  return to_mesh(*decimation->GetOutput());
}

}  // namespace lockbox
