// SPDX-License-Identifier: BSD-3-Clause
#include "point_actor.hpp"

#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <numeric>

namespace lockbox {
namespace {

/// One cell that draws all points.
vtkNew<vtkCellArray> all_points(std::size_t count) {
  std::vector<vtkIdType> ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  vtkNew<vtkCellArray> cells;
  if (count > 0) cells->InsertNextCell(static_cast<vtkIdType>(count), ids.data());
  return cells;
}

}  // namespace

PointActor::PointActor(vtkRenderer& renderer) {
  points_->SetDataTypeToFloat();
  colors_->SetNumberOfComponents(3);
  data_->SetPoints(points_);
  data_->GetPointData()->SetScalars(colors_);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data_);
  actor_->SetMapper(mapper);
  actor_->GetProperty()->LightingOff();
  renderer.AddActor(actor_);
}

void PointActor::set(const DisplayedScene& scene, double scale) {
  const auto count = static_cast<vtkIdType>(scene.points.size());
  if (points_->GetNumberOfPoints() != count) {
    points_->SetNumberOfPoints(count);
    colors_->SetNumberOfTuples(count);
    data_->SetVerts(all_points(scene.points.size()));
  }
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  std::copy_n(reinterpret_cast<const float*>(scene.points.data()), 3 * scene.points.size(),
              static_cast<float*>(points_->GetVoidPointer(0)));
  std::copy(scene.point_rgb.begin(), scene.point_rgb.end(), colors_->GetPointer(0));
  points_->Modified();
  colors_->Modified();
  actor_->GetProperty()->SetPointSize(static_cast<float>(scale * scene.point_size));
  actor_->SetVisibility(count > 0 ? 1 : 0);
}

}  // namespace lockbox
