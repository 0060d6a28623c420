// SPDX-License-Identifier: BSD-3-Clause
// Where the scene goes on beyond an edge of the model: a carton among cartons, a drawer between
// drawers, a board that is let into a wall.
//
// An edge of the model says where the model is because the scene ends there, or bends. Where the
// measured surface goes on in the plane of the model's own for as far as gates reach, its points
// say nothing about the edge: as many would be near to it wherever it were. Yet each of them pulls
// at the nearest side of the model, and against the sides that the camera sees there is nothing on
// those that it does not see: the estimate would creep along the plane, and be called sure.
//
// That is so of bodies that are flush with something: of whose contour at least a quarter goes on
// (docs/mathematics-refinement.md). Takes time in proportion to the edges of the view times the
// reach.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/view/view_edges.hpp"
#include "lockbox/view/view_options.hpp"
#include "lockbox/view/visible_surface.hpp"

namespace lockbox {

class TangentPlane;

/// Reuses its buffers.
class ContinuedEdges {
 public:
  /// Looks at the image, which the cloud must have, beyond the edges of a view of the model.
  /// reach: how far beyond (metres) points may pull, at least as far as it looks.
  void find(const ArticulatedModel& model, const VisibleSurface& surface, const ViewEdges& edges,
            const TiledCloud& cloud, double reach, const ViewOptions& options,
            const Executor& executor);

  /// Forgets them all: for clouds without an image.
  void clear() {
    is_any_ = false;
    is_flush_.clear();
  }

  /// Whether any pixel is covered.
  bool any() const { return is_any_; }

  /// Returns by body whether it is flush with something. Empty if no image was looked at.
  const std::vector<bool>& flush_bodies() const { return is_flush_; }

  /// Whether a pixel of the view lies beyond an edge of a flush body across which the scene goes
  /// on, within reach, or so near before it that the body's field is rounded there, or that noise
  /// along the ray may have brought a point of its face nearer to its side: what is measured there
  /// says nothing about where the model is.
  bool covers(std::size_t view_pixel) const { return is_any_ && covered_[view_pixel] != 0; }

 private:
  /// What lies beyond edges that are near each other and face the same way: standard deviations of
  /// a depth, behind the plane that goes on.
  struct Stretch {
    double measured = 0.0;      ///< sum over walks of the mean over each
    double measured_far = 0.0;  ///< the same over its farther half
    double predicted = 0.0;     ///< what the model shows instead
    int walks = 0;

    Stretch& operator+=(const Stretch& other);
  };
  /// From a pixel at an edge, along one of the four ways.
  struct Walk {
    int u;
    int v;
    int way;
    int length;  ///< pixels of the view, beyond
    int within;  ///< the same, before
    std::size_t stretch;
    Stretch found{};  ///< what lies beyond: of this walk alone
    /// If the body is flush: whether the scene beyond is nearer to the plane than to the model.
    bool goes_on = false;
  };
  /// Of one row of the view.
  struct Row {
    std::vector<Walk> walks;
    std::vector<Walk> seams;
  };

  void look_along(const VisibleSurface& surface, const ViewEdges& edges, const TiledCloud& cloud,
                  int v);
  void look_across(const VisibleSurface& surface, const TiledCloud& cloud,
                   const TangentPlane& plane, const Pixel& pixel, int way);
  bool walk(const VisibleSurface& surface, const TiledCloud& cloud, const TangentPlane& plane,
            Walk& walk) const;
  void add_up();
  Stretch around(std::size_t stretch) const;
  static bool lies_within(const Stretch& stretch, double limit);
  void find_flush_bodies(const RenderedDepth& view);
  bool is_of_flush_body(const Walk& walk, const RenderedDepth& view) const;
  void cover(const Walk& walk, const RenderedDepth& view);

  ViewOptions options_;
  double reach_ = 0.0;
  bool is_any_ = false;
  int columns_ = 0;  ///< of cells
  int rows_ = 0;
  std::vector<Stretch> stretches_;
  std::vector<double> rounded_;  ///< by body: metres from its edges where its field is round
  std::vector<Row> view_rows_;
  std::vector<bool> is_flush_;         ///< by body
  std::vector<int> going_on_;          ///< walks, by body
  std::vector<int> looked_at_;         ///< the same
  std::vector<std::uint8_t> covered_;  ///< by pixel of the view
};

}  // namespace lockbox
