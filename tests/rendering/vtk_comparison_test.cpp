// SPDX-License-Identifier: BSD-3-Clause
// DepthRenderer against VTK's OpenGL renderer, whose camera is set up by VTK's own means (view
// angle and window centre), so that a half-pixel error of ours has no counterpart there.
#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "lockbox/rendering/depth_renderer.hpp"
#include "test_scene.hpp"

namespace lockbox {
namespace {

constexpr double kNearPlane = 0.5;
constexpr double kFarPlane = 3.0;

// Its principal point is off the centre by a fraction of a pixel.
PinholeCamera off_centre_camera() {
  return {320, 240, 287.9, 287.9, 163.2, 115.4};
}

/// What the camera sees of one mesh: depth in metres, +infinity where nothing is.
class VtkDepth {
 public:
  VtkDepth(const TriangleMesh& mesh, const PinholeCamera& camera) : camera_(camera) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Eigen::Vector3d& p : mesh.vertices) {
      points->InsertNextPoint(p.data());
    }
    vtkNew<vtkCellArray> cells;
    for (const auto& [a, b, c] : mesh.triangles) {
      cells->InsertNextCell({vtkIdType{a}, vtkIdType{b}, vtkIdType{c}});
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(cells);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data);
    actor_->SetMapper(mapper);
    renderer_->AddActor(actor_);
    window_->SetMultiSamples(0);
    window_->SetOffScreenRendering(1);
    window_->SetSize(camera.width, camera.height);
    window_->AddRenderer(renderer_);
    aim(*renderer_->GetActiveCamera());
  }

  std::vector<float> depth(const Eigen::Isometry3d& T_camera_mesh) {
    vtkNew<vtkMatrix4x4> matrix;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        matrix->SetElement(row, column, T_camera_mesh.matrix()(row, column));
      }
    }
    actor_->SetUserMatrix(matrix);
    window_->Render();
    vtkNew<vtkFloatArray> buffer;
    window_->GetZbufferData(0, 0, camera_.width - 1, camera_.height - 1, buffer);
    return metres(*buffer);
  }

 private:
  void aim(vtkCamera& view) const {
    view.SetPosition(0.0, 0.0, 0.0);
    view.SetFocalPoint(0.0, 0.0, 1.0);
    view.SetViewUp(0.0, -1.0, 0.0);
    view.SetClippingRange(kNearPlane, kFarPlane);
    const double half_angle = std::atan(0.5 * camera_.height / camera_.fy);
    view.SetViewAngle(2.0 * half_angle * 180.0 / std::numbers::pi);
    // The window spans [-1, 1] along both axes; the image spans [-0.5, width - 0.5].
    view.SetWindowCenter(1.0 - 2.0 * (camera_.cx + 0.5) / camera_.width,
                         2.0 * (camera_.cy + 0.5) / camera_.height - 1.0);
  }

  /// VTK's rows run upwards, and its buffer holds OpenGL's depth: 1/z, mapped to [0, 1].
  std::vector<float> metres(vtkFloatArray& buffer) const {
    std::vector<float> result;
    for (int v = camera_.height - 1; v >= 0; --v) {
      for (int u = 0; u < camera_.width; ++u) {
        const double stored = buffer.GetValue(vtkIdType{v} * camera_.width + u);
        const double z = kNearPlane * kFarPlane / (kFarPlane - stored * (kFarPlane - kNearPlane));
        result.push_back(stored < 1.0 ? static_cast<float>(z) : INFINITY);
      }
    }
    return result;
  }

  PinholeCamera camera_;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
};

/// Where the contour lies, in pixels: mean first and last covered column of the rows that are
/// covered at all, mean first and last covered row of the columns.
Eigen::Vector4d contour(const std::vector<float>& depth, const PinholeCamera& camera) {
  std::vector<int> left(static_cast<std::size_t>(camera.height), camera.width);
  std::vector<int> right(left.size(), -1);
  std::vector<int> top(static_cast<std::size_t>(camera.width), camera.height);
  std::vector<int> bottom(top.size(), -1);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const auto row = static_cast<std::size_t>(v);
      const auto column = static_cast<std::size_t>(u);
      if (std::isfinite(depth[row * top.size() + column])) {
        left[row] = std::min(left[row], u);
        right[row] = u;
        top[column] = std::min(top[column], v);
        bottom[column] = v;
      }
    }
  }
  const auto mean_of_covered = [](const std::vector<int>& ends, const std::vector<int>& last) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      sum += last[i] >= 0 ? ends[i] : 0;
      count += last[i] >= 0 ? 1 : 0;
    }
    return sum / count;
  };
  return {mean_of_covered(left, right), mean_of_covered(right, right), mean_of_covered(top, bottom),
          mean_of_covered(bottom, bottom)};
}

class VtkComparison : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("DISPLAY") == nullptr) {
      GTEST_SKIP() << "VTK's OpenGL needs a display; run with xvfb-run";
    }
  }
};

TEST_F(VtkComparison, SameDepthInsideAndSameContourOverASubPixelSweep) {
  const PinholeCamera camera = off_centre_camera();
  const TriangleMesh mesh = testing::ball(0.3, 24);
  VtkDepth vtk(mesh, camera);
  DepthRenderer renderer(camera, Executor(1));
  RenderedDepth image;
  const double pixel = 1.2 / camera.fx;
  const int steps = 20;
  Eigen::Vector4d contour_difference = Eigen::Vector4d::Zero();
  for (int step = 0; step < steps; ++step) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << 0.05 + pixel * step / steps, -0.03 + 0.37 * pixel * step, 1.2;
    pose.linear() = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1.0, 2.0, 0.5).normalized()).matrix();
    const std::vector<RenderItem> items = {{&mesh, pose, 0}};
    renderer.render(items, image);
    const std::vector<float> expected = vtk.depth(pose);
    int inside = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      // Depth at the very contour changes by more than a float's worth with its own rounding.
      if (std::isfinite(expected[i]) && std::isfinite(image.depth[i]) && image.depth[i] < 1.1F) {
        ASSERT_NEAR(image.depth[i], expected[i], 1e-4) << i;
        ++inside;
      }
    }
    EXPECT_GT(inside, 5000);
    contour_difference += (contour(image.depth, camera) - contour(expected, camera)) / steps;
  }
  EXPECT_LT(contour_difference.cwiseAbs().maxCoeff(), 0.05) << contour_difference.transpose();
}

}  // namespace
}  // namespace lockbox
