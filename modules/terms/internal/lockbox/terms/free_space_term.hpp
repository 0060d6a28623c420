// SPDX-License-Identifier: BSD-3-Clause
// E_free: visible surface of the model that lies where the camera saw through is pulled to the
// nearest observed surface of the object, and contours of the model to where the camera saw them
// (docs/mathematics.md).
//
// A free-space violation: the measurement on the sample's ray lies more than a tolerance behind it.
// Samples behind the measurement are occluded, those on pixels without depth unknown; both are
// free.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lockbox/solver/normal_equations.hpp"
#include "lockbox/terms/correspondence_set.hpp"
#include "lockbox/terms/observed_contour.hpp"
#include "lockbox/terms/term_options.hpp"
#include "lockbox/view/contour_points.hpp"
#include "lockbox/view/view_samples.hpp"
#include "lockbox/view/visible_surface.hpp"

namespace lockbox {

class FreeSpaceTerm {
 public:
  /// What a selection is made from, by reference: the model as it was drawn, and the image.
  struct Scene {
    const ArticulatedModel& model;
    const VisibleSurface& surface;
    const ViewSamples& samples;       ///< of the surface
    const ContourPoints& contours;    ///< of the surface
    const ContinuedEdges& continued;  ///< of the surface
    const TiledCloud& cloud;
    const TermOptions& options;
    const Executor& executor;
  };

  /// Selects the samples that violate free space at these poses, and what they and the contours
  /// correspond to. annealing_sigma: metres that the poses may be off.
  void select(const Scene& scene, const BodyPoses& T_camera_body, double annealing_sigma);

  /// Adds each body's system, of the selected samples at these poses. annealing_sigma: how far off
  /// the poses may still be, metres. Returns the cost relative to that of all selected samples
  /// being outliers.
  double linearize(const BodyPoses& T_camera_body, double annealing_sigma,
                   std::vector<BodySystem>& systems);

  /// The cost at other poses under the selection of the last linearisation.
  double cost(const BodyPoses& T_camera_body) const;

  /// Adds the systems of the contours of the last linearisation once more.
  void add_contours(double weight, std::vector<BodySystem>& systems) const;

  /// Appends what each correspondence of the last linearisation had to say, with contours so many
  /// times. first_tile: number of the first tile of the image among the tiles of the systems.
  void append_tile_systems(const BodyPoses& T_camera_body, std::size_t first_tile,
                           double contour_weight, const Executor& executor,
                           std::vector<TileSystem>& systems) const;

  std::size_t matched_samples() const { return violations_.size() + contours_.size(); }

 private:
  void find_violations(const Scene& scene, const BodyPoses& T_camera_body, std::size_t chunk);
  void count_violations(std::size_t chunks);
  void aim_violations(const Scene& scene, const BodyPoses& T_camera_body, double annealing_sigma);
  void add_systems(const CorrespondenceSet& correspondences, const BodyPoses& T_camera_body,
                   double weight, std::vector<BodySystem>& systems, double& cost) const;
  kernels::CorrespondenceLoss correspondence_loss() const;
  void find_tile_systems(const CorrespondenceSet& correspondences, std::size_t block_index,
                         const BodyPoses& T_camera_body, std::size_t first_tile, double weight,
                         std::vector<TileSystem>& systems) const;

  BodyPoses T_body_camera_;
  double lambda_ = 1.0;
  double gate_ = 0.0;
  double annealing_variance_ = 0.0;  ///< m^2, of the last linearisation
  std::vector<std::vector<std::uint32_t>>
      chunk_violations_;                     ///< seen through: numbers within the chunk
  std::vector<std::size_t> chunk_begins_;    ///< how many before each chunk; all
  CorrespondenceSet violations_;             ///< by chunks of samples
  CorrespondenceSet contours_;               ///< by bands of contours
  std::vector<BodySystem> contour_systems_;  ///< by body, of the last linearisation
  mutable std::vector<std::vector<TileSystem>> block_systems_;  ///< of both; memory
  SampleLandings landings_;
  std::vector<ObservedContour> observed_contours_;  ///< by worker
};

}  // namespace lockbox
