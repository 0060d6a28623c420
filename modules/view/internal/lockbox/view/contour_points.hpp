// SPDX-License-Identifier: BSD-3-Clause
// Points of the model's contours, fixed to their bodies: where a body's visible surface ends, and
// the image shows something farther away beside it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "lockbox/model/articulated_model.hpp"
#include "lockbox/view/continued_edges.hpp"
#include "lockbox/view/view_edges.hpp"
#include "lockbox/view/view_options.hpp"
#include "lockbox/view/visible_surface.hpp"

namespace lockbox {

struct ContourPoint {
  Eigen::Vector3d p_body;       ///< metres, body frame
  Eigen::Vector3d normal_body;  ///< unit vector across the ray, out of the body
  double
      slope;  ///< of 1 / depth of the surface that ends here, relative, per metre along the normal
  double steepness;  ///< largest change of its depth a pixel of the camera, as a share of it
  double rise;       ///< metres that the surface before it comes nearer to the camera
  double pixels;     ///< of the camera along the contour, that it stands for
  int body;
};

/// Found band by band, by any threads. Reuses its buffers.
class ContourPoints {
 public:
  /// Where they are sought, by reference.
  struct Scene {
    const ArticulatedModel& model;
    const VisibleSurface& surface;
    const ViewEdges& edges;           ///< of the surface's view
    const ContinuedEdges& continued;  ///< those of them that are no contours
    int spacing;  ///< pixels of the camera from one point to the next, where the view has as many
    const ViewOptions& options;
  };

  ContourPoints();
  ~ContourPoints();
  ContourPoints(ContourPoints&&) noexcept;
  ContourPoints& operator=(ContourPoints&&) noexcept;

  /// Begins a view, before its bands are found.
  void begin(const RenderedDepth& view);
  void find_band(const Scene& scene, std::size_t i);

  /// Returns the number of bands of rows of the view, in each of which there may be no point.
  std::size_t bands() const;
  const std::vector<ContourPoint>& band(std::size_t i) const;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace lockbox
