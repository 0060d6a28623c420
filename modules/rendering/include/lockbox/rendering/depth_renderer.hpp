// SPDX-License-Identifier: BSD-3-Clause
// A z-buffer on the CPU: which mesh each pixel of a pinhole camera sees, and how far away.
//
// A pixel is one ray, through its centre (integer coordinates, see PinholeCamera); it belongs to
// the triangle that the ray hits, with no pixel lost or shared between neighbours (top-left rule).
// 1/z is linear in the image, so that depth is exact up to float rounding. Both faces of a triangle
// are drawn, unless it is known to bound a solid. Equal depths go to the earlier item. The same for
// any number of threads.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// A mesh to draw. The mesh is referred to, not copied.
struct RenderItem {
  const TriangleMesh* mesh = nullptr;  ///< must live until the image is drawn
  /// The pose of the mesh's frame in the camera's, metres.
  Eigen::Isometry3d T_camera_mesh = Eigen::Isometry3d::Identity();
  std::int16_t id = 0;  ///< what its pixels are marked with, not kNothing
  /// Whether the mesh encloses a solid (lockbox/mesh/mesh_audit.hpp). Faces seen from behind are
  /// left out then, which halves the work: nearer ones hide them.
  bool encloses_solid = false;
};

inline constexpr std::int16_t kNothing = -1;

/// A part of an image, pixels.
struct ImageWindow {
  int left = 0;    ///< the first column
  int top = 0;     ///< the first row
  int width = 0;   ///< columns
  int height = 0;  ///< rows

  /// Returns the column after the last one.
  int right() const { return left + width; }
  /// Returns the row after the last one.
  int bottom() const { return top + height; }
};

/// An image of depths and of what is seen, row by row, width * height values each.
struct RenderedDepth {
  int width = 0;                 ///< columns
  int height = 0;                ///< rows
  std::vector<float> depth;      ///< along the optical axis, metres; +infinity where nothing is
  std::vector<std::int16_t> id;  ///< of the nearest item; kNothing where nothing is
  ImageWindow drawn;             ///< outside it nothing is

  /// Returns where column u of row v is in these arrays.
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(u);
  }
};

/// A window of an image, row by row.
struct RenderedInverseDepth {
  int width = 0;                     ///< columns
  int height = 0;                    ///< rows
  std::vector<float> inverse_depth;  ///< 1/metre; 0 where nothing is
  std::vector<std::int16_t> id;      ///< of the nearest item; kNothing where nothing is
};

/// Draws meshes into depth images. It is reusable: after the first frame, frames of the same scene
/// allocate nothing.
class DepthRenderer {
 public:
  /// Surface nearer than this to the camera's plane is cut away, metres.
  static constexpr double kNear = 0.01;

  /// Makes a renderer whose images have the camera's size. The executor's workers draw them.
  DepthRenderer(const PinholeCamera& camera, const Executor& executor);
  ~DepthRenderer();
  DepthRenderer(DepthRenderer&&) noexcept;
  DepthRenderer& operator=(DepthRenderer&&) noexcept;

  /// Returns the camera of the images to come.
  const PinholeCamera& camera() const;
  /// Sets the camera of the images to come, and with it their size.
  void set_camera(const PinholeCamera& camera);

  /// Draws the items into the image, which is resized and overwritten.
  void render(std::span<const RenderItem> items, RenderedDepth& image);

  /// Begins to draw the items for who needs few parts of the image: draw() may be called for any of
  /// them, by several threads, until the next prepare(), render() or set_camera().
  void prepare(std::span<const RenderItem> items);
  /// Draws one window of what was prepared. The window must lie within the image; its first pixel
  /// becomes the first one of `part`, which is resized and overwritten.
  void draw(const ImageWindow& window, RenderedInverseDepth& part) const;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

/// Returns the camera whose pixels are blocks of factor x factor pixels of the given one; columns
/// and rows that fill no block are dropped.
PinholeCamera reduced(const PinholeCamera& camera, int factor);

/// Returns the camera with factor times as many samples along each axis; sample (factor u, factor
/// v) is pixel (u, v), and the outermost samples are the outermost pixels.
PinholeCamera refined(const PinholeCamera& camera, int factor);

}  // namespace lockbox
