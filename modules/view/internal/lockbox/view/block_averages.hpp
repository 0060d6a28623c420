// SPDX-License-Identifier: BSD-3-Clause
// The points of an image, averaged: where the model is predicted to show a flat face, the mean of
// the pixels of a square block takes their place. What they say about a face, its mean says as
// well.
//
// Only good from a prediction: a block is averaged that shows one face, if the model is right.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lockbox/cloud/point_tiles.hpp"
#include "lockbox/cloud/thinned_points.hpp"
#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/view/view_options.hpp"
#include "lockbox/view/visible_surface.hpp"

namespace lockbox {

/// Found band by band, by any threads. Buffers are reused: they allocate only where there are more
/// points than ever before.
class BlockAverages : public PointTiles {
 public:
  /// What is averaged, by reference. The cloud must have an image, all of it
  /// (TiledCloud::is_masked), seen by the camera that the surface is seen by. Blocks are as large
  /// as faces allow, from a cell of the density down to its spacing, or to least_spacing pixels of
  /// the view; one of the smallest that is not flat gives one pixel, which stands for all of it
  /// where a surface goes on over it: as one pixel of many it would leave narrow and round faces to
  /// their contours.
  struct Scene {
    const TiledCloud& cloud;
    const VisibleSurface& surface;
    const SamplingDensity& density;
    int least_spacing;
    const ViewOptions& options;
  };

  BlockAverages();
  ~BlockAverages();
  BlockAverages(BlockAverages&&) noexcept;
  BlockAverages& operator=(BlockAverages&&) noexcept;

  /// Begins a view, before the bands are filled.
  void begin(const SamplingDensity& density);
  std::size_t bands() const;
  void fill_band(const Scene& scene, std::size_t i);
  /// Ends a view, after all of them: what the object holds are their points.
  void finish();

 private:
  class Band;

  void find_flat(const RenderedDepth& view, int row_of_cells);

  std::vector<std::uint8_t> flat_;  ///< by pixel of the view, rows padded to whole cells
  std::unique_ptr<std::vector<Band>> bands_;
};

}  // namespace lockbox
