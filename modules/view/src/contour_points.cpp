// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/contour_points.hpp"

#include <algorithm>
#include <numeric>

#include "contour_finder.hpp"
#include "contour_rays.hpp"

namespace lockbox {
namespace {

/// Pixels of the view: rows that a thread takes at once, and columns of them whose rays follow each
/// other, as they look up neighbouring voxels. Source: not recorded. Doubled, neighbours are
/// farther apart.
constexpr int kRowsInBand = 16;
constexpr int kColumnsTogether = 8;

/// Some rows of the view.
class Band {
 public:
  const std::vector<ContourPoint>& points() const { return points_; }

  /// rows: of a part of the view.
  void find_points(const ContourFinder& finder, const ArticulatedModel& model,
                   const VisibleSurface& surface, const ImageWindow& rows) {
    jumps_.clear();
    for (int v = rows.top; v < rows.bottom(); ++v) finder.append_jumps(v, jumps_);
    bring_together(finder, model.fields.size(), rows.right());
    points_.clear();
    for (auto first = sorted_jumps_.begin(); first != sorted_jumps_.end();) {
      const int body = finder.body(first->u, first->v);
      const auto last = std::find_if(first, sorted_jumps_.end(), [&](const Pixel& jump) {
        return finder.body(jump.u, jump.v) != body;
      });
      rays_.clear();
      for (; first != last; ++first) {
        if (const auto pixel = finder.look_beside(first->u, first->v)) rays_.add(*pixel);
      }
      const auto b = static_cast<std::size_t>(body);
      rays_.touch(*model.fields[b], surface.T_body_camera()[b], surface.view_camera());
      add_points(finder);
    }
  }

 private:
  /// Sorts by body, then by groups of columns, within which the order stays.
  void bring_together(const ContourFinder& finder, std::size_t bodies, int columns) {
    const auto groups = static_cast<std::size_t>(columns / kColumnsTogether + 1);
    const auto group_of = [&](const Pixel& jump) {
      return static_cast<std::size_t>(finder.body(jump.u, jump.v)) * groups +
             static_cast<std::size_t>(jump.u / kColumnsTogether);
    };
    next_.assign(bodies * groups + 1, 0);
    for (const Pixel& jump : jumps_) ++next_[group_of(jump) + 1];
    std::partial_sum(next_.begin(), next_.end(), next_.begin());
    sorted_jumps_.resize(jumps_.size());
    for (const Pixel& jump : jumps_) sorted_jumps_[next_[group_of(jump)]++] = jump;
  }

  void add_points(const ContourFinder& finder) {
    for (std::size_t i = 0; i < rays_.pixels().size(); ++i) {
      const auto point = finder.point(rays_.pixels()[i], rays_.touch_of(i));
      if (point) finder.fill_in(*point, points_);
    }
  }

  std::vector<Pixel> jumps_;         ///< row by row
  std::vector<Pixel> sorted_jumps_;  ///< body by body
  std::vector<std::size_t> next_;    ///< of them, by body and group of columns
  ContourRays rays_;
  std::vector<ContourPoint> points_;
};

}  // namespace

struct ContourPoints::Workspace {
  std::vector<Band> bands;
};

ContourPoints::ContourPoints() : workspace_(std::make_unique<Workspace>()) {}
ContourPoints::~ContourPoints() = default;
ContourPoints::ContourPoints(ContourPoints&&) noexcept = default;
ContourPoints& ContourPoints::operator=(ContourPoints&&) noexcept = default;

void ContourPoints::begin(const RenderedDepth& view) {
  workspace_->bands.resize(static_cast<std::size_t>((view.height + kRowsInBand - 1) / kRowsInBand));
}

void ContourPoints::find_band(const Scene& scene, std::size_t i) {
  const RenderedDepth& view = scene.surface.view();
  const ContourFinder finder(scene.surface, scene.edges, scene.continued, scene.spacing,
                             scene.options);
  const int first_row = static_cast<int>(i) * kRowsInBand;
  ImageWindow rows = view.drawn;
  rows.top = std::max({first_row, 1, view.drawn.top});
  rows.height =
      std::min({first_row + kRowsInBand, view.height - 1, view.drawn.bottom()}) - rows.top;
  workspace_->bands[i].find_points(finder, scene.model, scene.surface, rows);
}

std::size_t ContourPoints::bands() const {
  return workspace_->bands.size();
}

const std::vector<ContourPoint>& ContourPoints::band(std::size_t i) const {
  return workspace_->bands[i].points();
}

}  // namespace lockbox
