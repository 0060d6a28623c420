// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/cloud/segmentation.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <functional>
#include <limits>

#include "cluster.hpp"
#include "lockbox/core/error.hpp"
#include "plane_segmentation.hpp"
#include "sample_grid.hpp"
#include "scene_planes.hpp"

namespace lockbox {
namespace {

/// Within so many standard deviations of a plane, and of no nearer one, a point lies in it.
constexpr double kOnPlane = 4.0;
/// Samples of clusters that stay are within this share of the margin: what is at its very end was
/// let in only to see planes continue.
constexpr double kClusterMargin = 0.5;

/// What a sample and its eight neighbours say about the pixels of its cell.
struct Cell {
  float nearest = std::numeric_limits<float>::infinity();    ///< depths of the object, metres
  float farthest = -std::numeric_limits<float>::infinity();  ///< metres
  std::bitset<kMaxPlanes> scene_planes;                      ///< those whose surface is seen
};

void check(const std::vector<ExpectedBody>& bodies, double margin) {
  const bool finite =
      std::isfinite(margin) && std::all_of(bodies.begin(), bodies.end(), [](const auto& body) {
        return body.T_camera_body.matrix().allFinite();
      });
  if (!finite) {
    throw InputError("segmentation", "margin and expected poses have to be finite numbers");
  }
}

double mean_distance(const std::vector<ExpectedBody>& bodies) {
  double sum = 0.0;
  double count = 0.0;
  for (const ExpectedBody& body : bodies) {
    if (!body.box.isEmpty()) {
      sum += (body.T_camera_body * body.box.center()).norm();
      count += 1.0;
    }
  }
  return sum / std::max(count, 1.0);
}

/// Pixels in the rectangle around the body that covers most of the image.
double expected_pixels(const PinholeCamera& camera, const std::vector<ExpectedBody>& bodies) {
  constexpr double kNear = 0.05;
  const Eigen::AlignedBox2d image(Eigen::Vector2d(-0.5, -0.5),
                                  Eigen::Vector2d(camera.width - 0.5, camera.height - 0.5));
  double most = 0.0;
  for (const ExpectedBody& body : bodies) {
    Eigen::AlignedBox2d in_image;
    for (int corner = 0; corner < 8 && !body.box.isEmpty(); ++corner) {
      const auto type = static_cast<Eigen::AlignedBox3d::CornerType>(corner);
      Eigen::Vector3d p_camera = body.T_camera_body * body.box.corner(type);
      p_camera.z() = std::max(p_camera.z(), kNear);
      in_image.extend(camera.project(p_camera));
    }
    const Eigen::AlignedBox2d visible = in_image.intersection(image);
    most = visible.isEmpty() ? most : std::max(most, visible.volume());
  }
  return most;
}

std::vector<std::uint8_t> outside_scene_planes(const std::vector<int>& surface,
                                               const std::vector<std::uint8_t>& is_scene) {
  std::vector<std::uint8_t> outside(surface.size());
  std::transform(surface.begin(), surface.end(), outside.begin(), [&](int plane) {
    return plane < 0 || is_scene[static_cast<std::size_t>(plane)] == 0 ? 1 : 0;
  });
  return outside;
}

std::vector<Cell> make_cells(const SampleGrid& grid, const std::vector<std::uint8_t>& object,
                             const std::vector<int>& surface,
                             const std::vector<std::uint8_t>& is_scene) {
  std::vector<Cell> cells(grid.size());
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      Cell& cell = cells[grid.index(column, row)];
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, grid.rows - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, grid.columns - 1); ++c) {
          const std::size_t sample = grid.index(c, r);
          if (object[sample] != 0) {
            cell.nearest = std::min(cell.nearest, (*grid.points)[sample].z);
            cell.farthest = std::max(cell.farthest, (*grid.points)[sample].z);
          }
          if (surface[sample] >= 0 && is_scene[static_cast<std::size_t>(surface[sample])] != 0) {
            cell.scene_planes.set(static_cast<std::size_t>(surface[sample]));
          }
        }
      }
    }
  }
  return cells;
}

/// Decides each pixel by its own depth: cells are coarse, and object and scene meet within them.
std::vector<std::uint8_t> to_pixels(const TiledCloud& cloud, const SampleGrid& grid,
                                    const std::vector<Cell>& cells,
                                    const std::vector<Plane>& planes, float tolerance, float gap) {
  const PinholeCamera& camera = cloud.camera();
  std::vector<std::uint8_t> mask(cloud.depth().size(), 0);
  std::size_t pixel = 0;
  for (int v = 0; v < camera.height; ++v) {
    const int row = std::min(v / grid.stride, grid.rows - 1);
    for (int u = 0; u < camera.width; ++u, ++pixel) {
      const Cell& cell = cells[grid.index(std::min(u / grid.stride, grid.columns - 1), row)];
      const float z = cloud.depth()[pixel];
      if (!(z > 0.0F && z > cell.nearest - gap && z < cell.farthest + gap)) {
        continue;
      }
      if (cell.scene_planes.any()) {
        const Eigen::Vector3f ray = camera.back_project(u, v, 1.0).cast<float>();
        const int plane = nearest_plane(planes, ray, 1.0F / z, tolerance);
        if (plane >= 0 && cell.scene_planes.test(static_cast<std::size_t>(plane))) {
          continue;
        }
      }
      mask[pixel] = 1;
    }
  }
  return mask;
}

}  // namespace

std::optional<std::vector<std::uint8_t>> ObjectSegmenter::segment(
    const TiledCloud& cloud, const std::vector<ExpectedBody>& bodies, double margin) const {
  check(bodies, margin);
  if (cloud.depth().empty()) {
    return std::nullopt;
  }
  const SampleGrid grid(cloud);
  const auto near = near_bodies(grid, bodies, margin);
  const std::vector<Plane> planes = find_planes(grid, options_.depth_noise);
  const auto tolerance = static_cast<float>(kOnPlane * options_.depth_noise);
  const std::vector<int> surface = surface_planes(grid, planes, tolerance);
  const auto is_scene = scene_planes(grid, planes, surface, near, bodies, margin);

  const double gap = options_.cluster_gap * mean_distance(bodies);
  auto object = clusters_of_object(grid, outside_scene_planes(surface, is_scene),
                                   near_bodies(grid, bodies, kClusterMargin * margin), gap);
  std::transform(object.begin(), object.end(), near.begin(), object.begin(), std::bit_and<>());
  const auto cells = make_cells(grid, object, surface, is_scene);
  auto mask = to_pixels(cloud, grid, cells, planes, tolerance, static_cast<float>(gap));
  const auto covered = static_cast<double>(std::count(mask.begin(), mask.end(), 1));
  const double required = options_.min_coverage * expected_pixels(cloud.camera(), bodies);
  if (covered == 0.0 || covered < required) {
    return std::nullopt;
  }
  return mask;
}

}  // namespace lockbox
