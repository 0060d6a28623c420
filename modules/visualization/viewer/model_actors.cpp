// SPDX-License-Identifier: BSD-3-Clause
#include "model_actors.hpp"

#include <vtkCellArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace lockbox {
namespace {

vtkNew<vtkPolyData> to_poly_data(const TriangleMesh& mesh) {
  vtkNew<vtkPoints> points;
  for (const auto& vertex : mesh.vertices) points->InsertNextPoint(vertex.data());
  vtkNew<vtkCellArray> triangles;
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles->InsertNextCell({vtkIdType{a}, vtkIdType{b}, vtkIdType{c}});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  return data;
}

vtkSmartPointer<vtkActor> make_actor(vtkPolyData* shape, const Eigen::Vector3f& part_color) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shape);
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->SetUserMatrix(vtkNew<vtkMatrix4x4>());
  vtkProperty& look = *actor->GetProperty();
  const Eigen::Vector3d color = part_color.cast<double>();
  look.SetColor(color.x(), color.y(), color.z());
  look.SetInterpolationToFlat();  // vertices carry no normals, and most edges are sharp
  look.SetAmbient(0.25);
  look.SetDiffuse(0.75);
  return actor;
}

}  // namespace

ModelActors::ModelActors(const std::vector<ScenePart>& parts, vtkRenderer& renderer) {
  for (const auto& part : parts) {
    actors_.push_back(make_actor(to_poly_data(*part.mesh), part.color));
    body_of_actor_.push_back(part.body);
    renderer.AddActor(actors_.back());
  }
}

ModelActors::ModelActors(const ModelActors& shapes, vtkRenderer& renderer,
                         const Eigen::Vector3f& color)
    : body_of_actor_(shapes.body_of_actor_) {
  for (const auto& actor : shapes.actors_) {
    auto* const mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
    actors_.push_back(make_actor(mapper->GetInput(), color));
    renderer.AddActor(actors_.back());
  }
}

void ModelActors::color(const std::vector<std::vector<std::uint8_t>>& part_rgb) {
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    auto* const mapper = vtkPolyDataMapper::SafeDownCast(actors_[i]->GetMapper());
    mapper->SetScalarVisibility(part_rgb.empty() ? 0 : 1);
    if (part_rgb.empty()) continue;
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetNumberOfComponents(3);
    colors->SetNumberOfTuples(static_cast<vtkIdType>(part_rgb[i].size() / 3));
    std::copy(part_rgb[i].begin(), part_rgb[i].end(), colors->GetPointer(0));
    mapper->GetInput()->GetPointData()->SetScalars(colors);
  }
}

void ModelActors::place(const std::vector<Eigen::Isometry3d>& T_camera_body, double opacity) {
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    actors_[i]->SetVisibility(T_camera_body.empty() ? 0 : 1);
    if (T_camera_body.empty()) continue;
    const Eigen::Matrix4d T = T_camera_body[body_of_actor_[i]].matrix().transpose();
    actors_[i]->GetUserMatrix()->DeepCopy(T.data());  // VTK's matrices lie row by row
    actors_[i]->GetProperty()->SetOpacity(opacity);
  }
}

}  // namespace lockbox
