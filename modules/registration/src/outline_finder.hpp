// SPDX-License-Identifier: BSD-3-Clause
// Where the outlines of one view pass: coarsely from the pixels of its z-buffer, precisely from the
// fields of the bodies.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/outline_points.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/registration/visible_surface.hpp"
#include "outline.hpp"

namespace lockbox {

/// A pixel of the view that shows a body, beside which an outline of it passes.
struct OutlinePixel {
  int body;
  int u;
  int v;
  TangentPlane plane;
  Eigen::Vector3d p;         ///< the surface in the pixel, camera frame
  Eigen::Vector3d outwards;  ///< normal of the outline as far as pixels tell it, camera frame
};

class OutlineFinder {
 public:
  /// All of these must outlive the object. spacing: see OutlinePoints::collect.
  OutlineFinder(const ArticulatedModel& model, const VisibleSurface& surface,
                const ViewEdges& edges, int spacing, const RegistrationOptions& options);

  /// The pixels of row v to look beside: they have a neighbour which lies farther away by more than
  /// noise.
  void append_jumps(int v, std::vector<Pixel>& pixels) const;

  /// That the pixel shows.
  int body(int u, int v) const { return view_.id[view_.index(u, v)]; }

  /// What lies beside a pixel that shows a body, if that is an outline.
  std::optional<OutlinePixel> look_beside(int u, int v) const;

  /// Where a ray passes the outline closely, body frame: the field is asked from there, for near an
  /// edge tri-linear distances and gradients err, the nearer the more.
  Eigen::Vector3d beside(const OutlinePixel& pixel) const;

  /// The same once the field has told the surface's normal there, body frame.
  Eigen::Vector3d beside(const OutlinePixel& pixel, const Eigen::Vector3d& normal) const;

  /// touch, normal: where such a ray touches the surface, body frame. Nothing where that disagrees
  /// with the pixels.
  std::optional<OutlinePoint> point(const OutlinePixel& pixel, const Eigen::Vector3d& touch,
                                    const Eigen::Vector3d& normal) const;

  /// Adds those beside one pixel of the view, along the outline from one that lies amidst them.
  void spread(const OutlinePoint& point, std::vector<OutlinePoint>& points) const;

 private:
  double depth(int u, int v) const { return static_cast<double>(view_.depth[view_.index(u, v)]); }
  double zone(double depth) const;
  double aside(const OutlinePixel& pixel) const;
  bool ends_beside(const TangentPlane& plane, int u, int v, double jump) const;
  bool stands_out(const Eigen::Vector3d& p, const Eigen::Vector3d& outwards) const;

  const ArticulatedModel& model_;
  const VisibleSurface& surface_;
  const RenderedDepth& view_;
  const ViewEdges& edges_;
  const PinholeCamera& camera_;
  const RegistrationOptions& options_;
  int points_per_pixel_;
};

}  // namespace lockbox
