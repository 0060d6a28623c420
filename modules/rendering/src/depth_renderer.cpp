// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/rendering/depth_renderer.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "screen_triangle.hpp"
#include "triangle_rows.hpp"

namespace lockbox {
namespace {

using rendering::Canvas;
using rendering::Edge;
using rendering::kBandRows;
using rendering::ScreenTriangle;
using rendering::Vertex;

constexpr std::size_t kChunk = 256;  ///< vertices or triangles that are prepared at once

/// A range of the vertices or triangles of one item.
struct Range {
  const RenderItem* item;
  std::size_t item_index;
  std::size_t first_vertex;  ///< of the item, among the vertices of all items
  std::size_t begin;
  std::size_t end;
};

/// The visible triangles of one range, with the rows and columns that they touch.
struct TriangleChunk {
  std::vector<ScreenTriangle> triangles;
  int first_row;
  int end_row;
  int first_column;
  int end_column;
};

/// Whether the rectangle around a triangle, or around those of a chunk, touches these rows of the
/// window.
template <class Shape>
bool touches(const Shape& shape, const ImageWindow& window, int first_row, int end_row) {
  return shape.first_row < end_row && shape.end_row > first_row &&
         shape.first_column < window.right() && shape.end_column > window.left;
}

/// Whether a triangle that touches these rows may cover columns of the window in them: of large
/// ones a small window mostly shows nothing.
bool may_cover(const ScreenTriangle& t, const ImageWindow& window, int first_row, int end_row) {
  const int first = std::max(first_row, t.first_row);
  const int last = std::min(end_row, t.end_row) - 1;
  const int last_upper = std::min(last, t.middle_row - 1);
  const int first_lower = std::max(first, t.middle_row);
  double left = std::min(t.whole.column(first), t.whole.column(last));
  double right = std::max(t.whole.column(first), t.whole.column(last));
  const auto extend = [&](const Edge& edge, int row) {
    left = std::min(left, edge.column(row));
    right = std::max(right, edge.column(row));
  };
  if (first <= last_upper) {
    extend(t.upper, first);
    extend(t.upper, last_upper);
  }
  if (first_lower <= last) {
    extend(t.lower, first_lower);
    extend(t.lower, last);
  }
  return left <= window.right() && right >= window.left;
}

/// A canvas in the memory of an image that shows this window.
template <class Image>
Canvas resize(const ImageWindow& window, std::vector<float>& inverse_z, Image& image) {
  image.width = window.width;
  image.height = window.height;
  const auto pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  inverse_z.resize(pixels);
  image.id.resize(pixels);
  return {window, inverse_z.data(), image.id.data()};
}

/// Finds the depths of rows that hold 1/z in the part that was drawn.
void find_depths(int first_row, int end_row, RenderedDepth& image) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (int row = first_row; row < end_row; ++row) {
    float* const depths = image.depth.data() + image.index(0, row);
    float* const begin = depths + image.drawn.left;
    float* const end = depths + image.drawn.right();
    std::fill(depths, begin, kInfinity);
    std::transform(begin, end, begin, [](float inverse_z) { return 1.0F / inverse_z; });
    std::fill(end, depths + image.width, kInfinity);
  }
}

void append_ranges(std::span<const RenderItem> items, std::size_t item, std::size_t first_vertex,
                   std::size_t count, std::vector<Range>& ranges) {
  for (std::size_t begin = 0; begin < count; begin += kChunk) {
    ranges.push_back({&items[item], item, first_vertex, begin, std::min(begin + kChunk, count)});
  }
}

}  // namespace

struct DepthRenderer::Workspace {
  PinholeCamera camera;
  Executor executor;
  std::vector<Vertex> vertices;  ///< of all items
  std::vector<Range> vertex_ranges;
  std::vector<Range> triangle_ranges;
  std::vector<TriangleChunk> chunks;      ///< one a triangle range; more are kept for later frames
  std::vector<std::uint8_t> is_cut;       ///< a vertex range: whether the near plane cuts it
  std::vector<std::uint8_t> shows_backs;  ///< an item

  void plan(std::span<const RenderItem> items);
  void project(std::size_t vertex_range);
  void find_visible_backs(std::span<const RenderItem> items);
  void prepare(const Range& range, TriangleChunk& chunk) const;
  ImageWindow drawn_part() const;
  void draw_band(int first_row, int end_row, const Canvas& canvas) const;
};

void DepthRenderer::Workspace::plan(std::span<const RenderItem> items) {
  vertex_ranges.clear();
  triangle_ranges.clear();
  std::size_t first_vertex = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const TriangleMesh& mesh = *items[i].mesh;
    append_ranges(items, i, first_vertex, mesh.vertices.size(), vertex_ranges);
    append_ranges(items, i, first_vertex, mesh.triangles.size(), triangle_ranges);
    first_vertex += mesh.vertices.size();
  }
  vertices.resize(first_vertex);
  is_cut.resize(vertex_ranges.size());
  if (chunks.size() < triangle_ranges.size()) {
    chunks.resize(triangle_ranges.size());
  }
}

void DepthRenderer::Workspace::project(std::size_t vertex_range) {
  const Range& range = vertex_ranges[vertex_range];
  bool cut = false;
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const Vertex vertex =
        rendering::projected(camera, range.item->T_camera_mesh * range.item->mesh->vertices[i]);
    vertices[range.first_vertex + i] = vertex;
    cut = cut || !(vertex.p_camera.z() >= kNear);
  }
  is_cut[vertex_range] = cut ? 1 : 0;
}

/// Finds backs that can be seen. Of a solid, fronts hide all backs, unless the near plane cuts it
/// open.
void DepthRenderer::Workspace::find_visible_backs(std::span<const RenderItem> items) {
  shows_backs.resize(items.size());
  std::transform(items.begin(), items.end(), shows_backs.begin(),
                 [](const RenderItem& item) { return item.encloses_solid ? 0 : 1; });
  for (std::size_t i = 0; i < vertex_ranges.size(); ++i) {
    shows_backs[vertex_ranges[i].item_index] |= is_cut[i];
  }
}

void DepthRenderer::Workspace::prepare(const Range& range, TriangleChunk& chunk) const {
  const Vertex* vertex = vertices.data() + range.first_vertex;
  const bool draws_backs = shows_backs[range.item_index] != 0;
  chunk.triangles.clear();
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const auto& [a, b, c] = range.item->mesh->triangles[i];
    if (draws_backs || rendering::shows_front(vertex[a], vertex[b], vertex[c])) {
      rendering::append_screen_triangles(camera, kNear, vertex[a], vertex[b], vertex[c],
                                         range.item->id, chunk.triangles);
    }
  }
  chunk.first_row = camera.height;
  chunk.end_row = 0;
  chunk.first_column = camera.width;
  chunk.end_column = 0;
  for (const ScreenTriangle& t : chunk.triangles) {
    chunk.first_row = std::min(chunk.first_row, t.first_row);
    chunk.end_row = std::max(chunk.end_row, t.end_row);
    chunk.first_column = std::min(chunk.first_column, t.first_column);
    chunk.end_column = std::max(chunk.end_column, t.end_column);
  }
}

/// The part of the image that triangles may touch.
ImageWindow DepthRenderer::Workspace::drawn_part() const {
  int left = camera.width;
  int top = camera.height;
  int right = 0;
  int bottom = 0;
  for (std::size_t i = 0; i < triangle_ranges.size(); ++i) {
    if (chunks[i].triangles.empty()) continue;
    left = std::min(left, chunks[i].first_column);
    top = std::min(top, chunks[i].first_row);
    right = std::max(right, chunks[i].end_column);
    bottom = std::max(bottom, chunks[i].end_row);
  }
  if (left >= right || top >= bottom) return {};
  return {left, top, right - left, bottom - top};
}

/// Rows of the camera's image, at most kBandRows of them.
void DepthRenderer::Workspace::draw_band(int first_row, int end_row, const Canvas& canvas) const {
  const std::size_t begin = canvas.index(canvas.window.left, first_row);
  const std::size_t end = canvas.index(canvas.window.left, end_row);
  std::fill(canvas.inverse_z + begin, canvas.inverse_z + end, 0.0F);
  std::fill(canvas.ids + begin, canvas.ids + end, kNothing);
  for (std::size_t i = 0; i < triangle_ranges.size(); ++i) {
    if (!touches(chunks[i], canvas.window, first_row, end_row)) continue;
    for (const ScreenTriangle& t : chunks[i].triangles) {
      if (touches(t, canvas.window, first_row, end_row) &&
          may_cover(t, canvas.window, first_row, end_row)) {
        draw_rows(t, first_row, end_row, canvas);
      }
    }
  }
}

DepthRenderer::DepthRenderer(const PinholeCamera& camera, const Executor& executor)
    : workspace_(new Workspace{camera, executor, {}, {}, {}, {}, {}, {}}) {}

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
  prepare(items);
  const Workspace& w = *workspace_;
  const ImageWindow whole{0, 0, w.camera.width, w.camera.height};
  const Canvas canvas = resize(whole, image.depth, image);
  image.drawn = w.drawn_part();
  w.executor.for_each_chunk(static_cast<std::size_t>(image.height), kBandRows,
                            [&](std::size_t begin, std::size_t end, std::size_t) {
                              const int first_row = static_cast<int>(begin);
                              const int end_row = static_cast<int>(end);
                              w.draw_band(first_row, end_row, canvas);
                              find_depths(first_row, end_row, image);
                            });
}

void DepthRenderer::prepare(std::span<const RenderItem> items) {
  Workspace& w = *workspace_;
  w.plan(items);
  w.executor.for_each(w.vertex_ranges.size(), [&](std::size_t i) { w.project(i); });
  w.find_visible_backs(items);
  w.executor.for_each(w.triangle_ranges.size(),
                      [&](std::size_t i) { w.prepare(w.triangle_ranges[i], w.chunks[i]); });
}

void DepthRenderer::draw(const ImageWindow& window, RenderedInverseDepth& part) const {
  const Canvas canvas = resize(window, part.inverse_depth, part);
  const int end = window.bottom();
  for (int row = window.top; row < end; row += kBandRows) {
    workspace_->draw_band(row, std::min(row + kBandRows, end), canvas);
  }
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
