// SPDX-License-Identifier: BSD-3-Clause
// The points of an image, pooled: where the model is predicted to show a flat face, the mean of the
// pixels of a square block takes their place. What they say about a face, its mean says as well.
//
// Only good from a prediction: a block is pooled that shows one face, if the model is right.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lockbox/cloud/point_tiles.hpp"
#include "lockbox/cloud/thinned_points.hpp"
#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/registration/visible_surface.hpp"

namespace lockbox {

/// Buffers are reused: assign() allocates only where there are more points than ever before.
class PooledPoints : public PointTiles {
 public:
  PooledPoints();
  ~PooledPoints();
  PooledPoints(PooledPoints&&) noexcept;
  PooledPoints& operator=(PooledPoints&&) noexcept;

  /// Blocks are as large as faces allow, from a cell of the density down to its spacing, or to
  /// least_spacing pixels of the view; one of the smallest that shows more than one face gives the
  /// pixel in its middle. The cloud must have
  /// an image, all of it (TiledCloud::is_masked), seen by the camera that the surface is seen by.
  void assign(const TiledCloud& cloud, const VisibleSurface& surface,
              const SamplingDensity& density, int least_spacing, const RegistrationOptions& options,
              const Executor& executor);

 private:
  class Band;
  struct Scene;

  void find_flat(const RenderedDepth& view, int row_of_cells);

  std::vector<std::uint8_t> flat_;  ///< by pixel of the view, rows padded to whole cells
  std::unique_ptr<std::vector<Band>> bands_;
};

}  // namespace lockbox
