// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/reprojected_view.hpp"

#include "lockbox/registration/rigid_motion.hpp"

namespace lockbox {
namespace {

kernels::Intrinsics intrinsics(const PinholeCamera& camera) {
  return {static_cast<float>(camera.fx),
          static_cast<float>(camera.fy),
          static_cast<float>(camera.cx),
          static_cast<float>(camera.cy),
          camera.width,
          camera.height};
}

}  // namespace

ReprojectedView::ReprojectedView(const VisibleSurface& surface, const BodyPoses& T_camera_body,
                                 const TiledCloud& cloud, const Executor& executor,
                                 Scratch& scratch)
    : surface_(surface),
      scratch_(scratch),
      drawn_(intrinsics(surface.view_camera())),
      measured_{cloud.depth().data(), intrinsics(cloud.camera())} {
  scratch.motion.resize(T_camera_body.size());
  for (std::size_t b = 0; b < T_camera_body.size(); ++b) {
    scratch.motion[b] = to_rigid_motion(T_camera_body[b] * surface.T_body_camera()[b]);
  }
  const auto workers = static_cast<std::size_t>(executor.threads()) + 1;
  const std::size_t columns = kernels::padded(static_cast<std::size_t>(surface.view().width));
  for (auto* arrays : {&scratch.expected, &scratch.measured}) {
    arrays->resize(workers);
    for (auto& array : *arrays) {
      array.resize(columns);
    }
  }
  scratch.columns.resize(workers);
  for (auto& array : scratch.columns) {
    array.resize(columns);
  }
  scratch.pixel.resize(workers);
  for (auto& array : scratch.pixel) {
    array.resize(columns);
  }
}

kernels::Reprojected ReprojectedView::row(int v) const {
  const RenderedDepth& view = surface_.view();
  const auto width = static_cast<std::size_t>(view.width);
  const std::size_t first = static_cast<std::size_t>(v) * width;
  const std::size_t worker = Executor::worker();
  const kernels::Reprojected result{scratch_.expected[worker].data(),
                                    scratch_.measured[worker].data(),
                                    scratch_.pixel[worker].data()};
  kernels::reproject({view.depth.data() + first, view.id.data() + first, width, v}, drawn_,
                     scratch_.motion, measured_, result);
  return result;
}

std::span<const std::uint32_t> ReprojectedView::seen_through(int v, const SensorNoise& noise,
                                                             double zone) const {
  const kernels::Reprojected reprojected = row(v);
  std::uint32_t* columns = scratch_.columns[Executor::worker()].data();
  const kernels::PointNoise along_ray{static_cast<float>(noise.depth_floor),
                                      static_cast<float>(noise.depth_quadratic), 0.0F, 0.0F};
  const std::size_t count =
      kernels::seen_through(reprojected, static_cast<std::size_t>(surface_.view().width), along_ray,
                            static_cast<float>(zone), columns);
  return {columns, count};
}

}  // namespace lockbox
