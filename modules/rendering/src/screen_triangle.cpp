// SPDX-License-Identifier: BSD-3-Clause
#include "screen_triangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace lockbox::rendering {
namespace {

Edge edge_between(const Vertex& top, const Vertex& bottom) {
  const double rows = bottom.v - top.v;
  return {top.u, top.v, rows > 0.0 ? (bottom.u - top.u) / rows : 0.0};
}

void append_projected(const Vertex& a, const Vertex& b, const Vertex& c, std::int16_t id,
                      std::vector<ScreenTriangle>& triangles) {
  // Most triangles of a fine mesh lie between pixel centres.
  if ((a.column == b.column && a.column == c.column) || (a.row == b.row && a.row == c.row)) {
    return;
  }
  std::array<const Vertex*, 3> sorted = {&a, &b, &c};
  std::sort(sorted.begin(), sorted.end(),
            [](const Vertex* p, const Vertex* q) { return p->v < q->v; });
  const Vertex& top = *sorted[0];
  const Vertex& middle = *sorted[1];
  const Vertex& bottom = *sorted[2];
  ScreenTriangle t;
  t.first_row = top.row;
  t.middle_row = middle.row;
  t.end_row = bottom.row;
  std::tie(t.first_column, t.end_column) = std::minmax({a.column, b.column, c.column});

  const double middle_u = middle.u - top.u;
  const double middle_v = middle.v - top.v;
  const double bottom_u = bottom.u - top.u;
  const double bottom_v = bottom.v - top.v;
  const double area = middle_u * bottom_v - bottom_u * middle_v;
  // Seen edge-on: no gradient can be had, and no pixel centre is inside.
  if (!(std::abs(area) > 1e-12)) {
    return;
  }
  t.whole = edge_between(top, bottom);
  t.upper = edge_between(top, middle);
  t.lower = edge_between(middle, bottom);
  t.whole_is_left = area > 0.0;

  const double middle_w = middle.inverse_z - top.inverse_z;
  const double bottom_w = bottom.inverse_z - top.inverse_z;
  t.u0 = top.u;
  t.v0 = top.v;
  t.inverse_z = top.inverse_z;
  t.du = (middle_w * bottom_v - bottom_w * middle_v) / area;
  t.dv = (middle_u * bottom_w - bottom_u * middle_w) / area;
  const auto [low, high] = std::minmax({a.inverse_z, b.inverse_z, c.inverse_z});
  t.low = static_cast<float>(low);
  t.high = static_cast<float>(high);
  t.id = id;
  triangles.push_back(t);
}

/// Where the edge meets the near plane. Always asked from behind the plane to before it, so that
/// the two triangles at the edge get the same point.
Vertex crossing(const PinholeCamera& camera, double near, const Vertex& behind,
                const Vertex& before) {
  const double share = (behind.p_camera.z() - near) / (behind.p_camera.z() - before.p_camera.z());
  Eigen::Vector3d p = behind.p_camera + share * (before.p_camera - behind.p_camera);
  p.z() = near;
  return projected(camera, p);
}

}  // namespace

Vertex projected(const PinholeCamera& camera, const Eigen::Vector3d& p_camera) {
  const double inverse_z = 1.0 / p_camera.z();
  const double u = camera.fx * p_camera.x() * inverse_z + camera.cx;
  const double v = camera.fy * p_camera.y() * inverse_z + camera.cy;
  return {p_camera, u, v, inverse_z, first_centre(u, camera.width), first_centre(v, camera.height)};
}

void append_screen_triangles(const PinholeCamera& camera, double near, const Vertex& a,
                             const Vertex& b, const Vertex& c, std::int16_t id,
                             std::vector<ScreenTriangle>& triangles) {
  std::array<const Vertex*, 3> v = {&a, &b, &c};
  const auto visible = [near](const Vertex* vertex) { return vertex->p_camera.z() >= near; };
  const auto count = std::count_if(v.begin(), v.end(), visible);
  if (count == 3) {
    append_projected(a, b, c, id, triangles);
  } else if (count == 2) {
    while (visible(v[2])) {
      std::rotate(v.begin(), v.begin() + 1, v.end());
    }
    const Vertex d = crossing(camera, near, *v[1], *v[2]);
    const Vertex e = crossing(camera, near, *v[0], *v[2]);
    append_projected(*v[0], *v[1], d, id, triangles);
    append_projected(*v[0], d, e, id, triangles);
  } else if (count == 1) {
    while (!visible(v[0])) {
      std::rotate(v.begin(), v.begin() + 1, v.end());
    }
    append_projected(*v[0], crossing(camera, near, *v[0], *v[1]),
                     crossing(camera, near, *v[0], *v[2]), id, triangles);
  }
}

}  // namespace lockbox::rendering
