// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/rendering/depth_renderer.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "screen_triangle.hpp"

namespace lockbox {
namespace {

using rendering::first_centre;
using rendering::ScreenTriangle;
using rendering::Vertex;

constexpr std::size_t kChunk = 256;  ///< vertices or triangles that are prepared at once
constexpr int kBandRows = 16;        ///< rows of the image that are drawn at once

/// A range of the vertices or triangles of one item.
struct Range {
  const RenderItem* item;
  std::size_t first_vertex;  ///< of the item, among the vertices of all items
  std::size_t begin;
  std::size_t end;
};

/// The visible triangles of one range, with the rows that they touch.
struct TriangleChunk {
  std::vector<ScreenTriangle> triangles;
  int first_row;
  int end_row;
};

void append_ranges(const RenderItem& item, std::size_t first_vertex, std::size_t count,
                   std::vector<Range>& ranges) {
  for (std::size_t begin = 0; begin < count; begin += kChunk) {
    ranges.push_back({&item, first_vertex, begin, std::min(begin + kChunk, count)});
  }
}

/// Without branches, so that the compiler makes it SIMD; `inverse_z` holds 1/z of what is nearest.
void draw_span(float start, float step, float low, float high, std::int16_t id, int count,
               float* __restrict inverse_z, std::int16_t* __restrict ids) {
  for (int i = 0; i < count; ++i) {
    const float candidate = std::min(std::max(start + step * static_cast<float>(i), low), high);
    const float nearest = inverse_z[i];
    const int keep = -static_cast<int>(candidate <= nearest);
    inverse_z[i] = std::max(nearest, candidate);
    ids[i] = static_cast<std::int16_t>((ids[i] & keep) | (id & ~keep));
  }
}

void draw_rows(const ScreenTriangle& t, int first_row, int end_row, RenderedDepth& image) {
  const int end = std::min(end_row, t.end_row);
  for (int row = std::max(first_row, t.first_row); row < end; ++row) {
    const double whole = t.whole.column(row);
    const double broken = row < t.middle_row ? t.upper.column(row) : t.lower.column(row);
    const int left = first_centre(t.whole_is_left ? whole : broken, image.width);
    const int right = first_centre(t.whole_is_left ? broken : whole, image.width);
    if (left >= right) {
      continue;
    }
    const double start = t.inverse_z + (left - t.u0) * t.du + (row - t.v0) * t.dv;
    const std::size_t first =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
        static_cast<std::size_t>(left);
    draw_span(static_cast<float>(start), static_cast<float>(t.du), t.low, t.high, t.id,
              right - left, &image.depth[first], &image.id[first]);
  }
}

}  // namespace

struct DepthRenderer::Workspace {
  PinholeCamera camera;
  Executor executor;
  std::vector<Vertex> vertices;  ///< of all items
  std::vector<Range> vertex_ranges;
  std::vector<Range> triangle_ranges;
  std::vector<TriangleChunk> chunks;  ///< one a triangle range; more are kept for later frames

  void plan(std::span<const RenderItem> items);
  void project(const Range& range);
  void prepare(const Range& range, TriangleChunk& chunk) const;
  void draw_band(int first_row, int end_row, RenderedDepth& image) const;
};

void DepthRenderer::Workspace::plan(std::span<const RenderItem> items) {
  vertex_ranges.clear();
  triangle_ranges.clear();
  std::size_t first_vertex = 0;
  for (const RenderItem& item : items) {
    append_ranges(item, first_vertex, item.mesh->vertices.size(), vertex_ranges);
    append_ranges(item, first_vertex, item.mesh->triangles.size(), triangle_ranges);
    first_vertex += item.mesh->vertices.size();
  }
  vertices.resize(first_vertex);
  if (chunks.size() < triangle_ranges.size()) {
    chunks.resize(triangle_ranges.size());
  }
}

void DepthRenderer::Workspace::project(const Range& range) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    vertices[range.first_vertex + i] =
        rendering::projected(camera, range.item->T_camera_mesh * range.item->mesh->vertices[i]);
  }
}

void DepthRenderer::Workspace::prepare(const Range& range, TriangleChunk& chunk) const {
  const Vertex* vertex = vertices.data() + range.first_vertex;
  chunk.triangles.clear();
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const auto& [a, b, c] = range.item->mesh->triangles[i];
    rendering::append_screen_triangles(camera, kNear, vertex[a], vertex[b], vertex[c],
                                       range.item->id, chunk.triangles);
  }
  chunk.first_row = camera.height;
  chunk.end_row = 0;
  for (const ScreenTriangle& t : chunk.triangles) {
    chunk.first_row = std::min(chunk.first_row, t.first_row);
    chunk.end_row = std::max(chunk.end_row, t.end_row);
  }
}

void DepthRenderer::Workspace::draw_band(int first_row, int end_row, RenderedDepth& image) const {
  const auto width = static_cast<std::ptrdiff_t>(image.width);
  const auto begin = first_row * width;
  const auto end = end_row * width;
  // Until the band is complete, its depths hold 1/z: 0 is infinitely far.
  std::fill(image.depth.begin() + begin, image.depth.begin() + end, 0.0F);
  std::fill(image.id.begin() + begin, image.id.begin() + end, kNothing);
  for (std::size_t i = 0; i < triangle_ranges.size(); ++i) {
    if (chunks[i].first_row >= end_row || chunks[i].end_row <= first_row) {
      continue;
    }
    for (const ScreenTriangle& t : chunks[i].triangles) {
      if (t.first_row < end_row && t.end_row > first_row) {
        draw_rows(t, first_row, end_row, image);
      }
    }
  }
  std::transform(image.depth.begin() + begin, image.depth.begin() + end,
                 image.depth.begin() + begin, [](float inverse_z) { return 1.0F / inverse_z; });
}

DepthRenderer::DepthRenderer(const PinholeCamera& camera, const Executor& executor)
    : workspace_(new Workspace{camera, executor, {}, {}, {}, {}}) {}

DepthRenderer::~DepthRenderer() = default;
DepthRenderer::DepthRenderer(DepthRenderer&&) noexcept = default;
DepthRenderer& DepthRenderer::operator=(DepthRenderer&&) noexcept = default;

const PinholeCamera& DepthRenderer::camera() const {
  return workspace_->camera;
}

void DepthRenderer::set_camera(const PinholeCamera& camera) {
  workspace_->camera = camera;
}

void DepthRenderer::render(std::span<const RenderItem> items, RenderedDepth& image) {
  Workspace& w = *workspace_;
  image.width = w.camera.width;
  image.height = w.camera.height;
  const auto pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.depth.resize(pixels);
  image.id.resize(pixels);
  w.plan(items);
  w.executor.for_each(w.vertex_ranges.size(),
                      [&](std::size_t i) { w.project(w.vertex_ranges[i]); });
  w.executor.for_each(w.triangle_ranges.size(),
                      [&](std::size_t i) { w.prepare(w.triangle_ranges[i], w.chunks[i]); });
  w.executor.for_each_chunk(static_cast<std::size_t>(image.height), kBandRows,
                            [&](std::size_t begin, std::size_t end, std::size_t) {
                              w.draw_band(static_cast<int>(begin), static_cast<int>(end), image);
                            });
}

PinholeCamera reduced(const PinholeCamera& camera, int factor) {
  const double centre = 0.5 * (factor - 1);
  return {camera.width / factor, camera.height / factor,        camera.fx / factor,
          camera.fy / factor,    (camera.cx - centre) / factor, (camera.cy - centre) / factor};
}

PinholeCamera refined(const PinholeCamera& camera, int factor) {
  return {(camera.width - 1) * factor + 1,
          (camera.height - 1) * factor + 1,
          camera.fx * factor,
          camera.fy * factor,
          camera.cx * factor,
          camera.cy * factor};
}

}  // namespace lockbox
