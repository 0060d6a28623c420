// SPDX-License-Identifier: BSD-3-Clause
// Points of the model's visible surface, fixed to their bodies, and what the camera measured where
// they are now.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lockbox/cloud/thinned_points.hpp"
#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/kernels/reprojection.hpp"
#include "lockbox/view/visible_surface.hpp"

namespace lockbox {

struct ViewSample {
  Eigen::Vector3f p_body;  ///< metres, body frame
  int body;
  Pixel pixel;    ///< of the view
  double pixels;  ///< of the camera, that it stands for
};

/// Chosen first, then placed row by row, by any threads. Reuses its buffers.
class ViewSamples {
 public:
  /// Samples of a chunk; fixed, so that sums do not depend on threads. Source: not recorded.
  /// Doubled, threads share the work out less evenly.
  static constexpr std::size_t kMostInChunk = 512;

  /// Samples of one body: numbers [first, first + count), padded for the kernels.
  struct Chunk {
    int body;
    std::size_t first;
    std::size_t count;
  };

  /// Chooses samples of the surface as it was drawn; the density must be one for its view. Samples
  /// are not closer than least_spacing, pixels of the view.
  void choose(const VisibleSurface& surface, const SamplingDensity& density, int least_spacing,
              const Executor& executor);
  std::size_t rows() const { return rows_.size(); }
  void place_row(const VisibleSurface& surface, std::size_t row);
  /// Ends a view, after all rows.
  void finish();

  const std::vector<Chunk>& chunks() const { return chunks_; }
  kernels::PointSpan points(const Chunk& chunk) const {
    return {x_.data() + chunk.first, y_.data() + chunk.first, z_.data() + chunk.first,
            kernels::padded(chunk.count)};
  }
  ViewSample sample(int body, std::size_t number) const {
    const auto& [pixel, spacing] = places_[number];
    const double along = static_cast<double>(spacing) * scale_;
    return {{x_[number], y_[number], z_[number]}, body, pixel, along * along};
  }

 private:
  struct Place {
    Pixel pixel;  ///< of the view
    int spacing;
  };
  /// Samples of a row of cells.
  struct Row {
    std::vector<Place> chosen;      ///< cell by cell
    std::vector<std::size_t> next;  ///< by body: how many, then the number of the next one
  };
  static void choose_in(const RenderedDepth& view, const SamplingDensity& density,
                        int least_spacing, int row_of_cells, Row& row);
  void lay_out(std::size_t bodies);

  std::vector<float> x_;  ///< by number, metres, body frame
  std::vector<float> y_;
  std::vector<float> z_;
  std::vector<Place> places_;
  std::vector<Chunk> chunks_;
  int scale_ = 1;
  std::vector<Row> rows_;
};

/// Where a chunk of samples lands in the image: memory of its own for each worker.
class SampleLandings {
 public:
  void reserve(const Executor& executor);

  /// Valid until the same worker asks for the next chunk.
  kernels::Landings land(const ViewSamples& samples, const ViewSamples::Chunk& chunk,
                         const BodyPoses& T_camera_body, const TiledCloud& cloud);

 private:
  struct Buffers {
    std::vector<float> expected;
    std::vector<float> x;
    std::vector<float> y;
    std::vector<float> measured;
    std::vector<std::int32_t> pixel;
  };
  std::vector<Buffers> buffers_;  ///< by worker
};

}  // namespace lockbox
