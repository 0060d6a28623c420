// SPDX-License-Identifier: BSD-3-Clause
// Where the contours of one view pass: coarsely from the pixels of its z-buffer, precisely from the
// fields of the bodies.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "contour_rays.hpp"
#include "lockbox/view/contour_points.hpp"
#include "lockbox/view/view_options.hpp"
#include "lockbox/view/visible_surface.hpp"

namespace lockbox {

class ContourFinder {
 public:
  /// All of these must outlive the object. spacing: see ContourPoints::Scene.
  ContourFinder(const VisibleSurface& surface, const ViewEdges& edges,
                const ContinuedEdges& continued, int spacing, const ViewOptions& options);

  /// The pixels of row v to look beside: they have a neighbour which lies farther away by more than
  /// noise.
  void append_jumps(int v, std::vector<Pixel>& pixels) const;

  /// That the pixel shows.
  int body(int u, int v) const { return view_.id[view_.index(u, v)]; }

  /// What lies beside a pixel that shows a body, if that is a contour.
  std::optional<ContourPixel> look_beside(int u, int v) const;

  /// Where a ray that was aimed past such a pixel touches the body. Nothing where that disagrees
  /// with the pixels.
  std::optional<ContourPoint> point(const ContourPixel& pixel, const ContourTouch& touch) const;

  /// Adds those beside one pixel of the view, along the contour from one that lies amidst them.
  void fill_in(const ContourPoint& point, std::vector<ContourPoint>& points) const;

 private:
  double depth(int u, int v) const { return static_cast<double>(view_.depth[view_.index(u, v)]); }
  double zone(double depth) const;
  bool ends_beside(const TangentPlane& plane, int u, int v, double jump) const;
  bool stands_out(const ContourTouch& touch) const;

  const VisibleSurface& surface_;
  const RenderedDepth& view_;
  const ViewEdges& edges_;
  const ContinuedEdges& continued_;
  const PinholeCamera& camera_;
  const ViewOptions& options_;
  int points_per_pixel_;
};

}  // namespace lockbox
