// SPDX-License-Identifier: BSD-3-Clause
// What the scene would show without the model: the planes around it, which go on.
//
// A model that is put half into a table, or just under it, is hidden by it, and what is left is
// measured where the table is, too. A table that is cut by the model and hides the rest of it is no
// occluder: it is the scene without the object.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/registration/visible_surface.hpp"

namespace lockbox {

/// Reuses its buffers. Takes time in proportion to the pixels of the view around the model, up to
/// a few hundred, and to those of the model.
class PlanesAround {
 public:
  /// The log-likelihood ratio of the model against the planes around it, over its visible surface,
  /// as a share of what it would be if all of that were measured where the model says and no plane
  /// is: 1 at most, and -1 at least, where all that the model shows is hidden by the planes. A
  /// pixel that shows neither, an occluder's, says nothing. None if there are no planes that the
  /// model does not lie behind.
  std::optional<double> evidence(const VisibleSurface& surface, const TiledCloud& cloud,
                                 const RegistrationOptions& options);

 private:
  /// In an image of a plane 1 / depth is linear: 1/metre, in (column, row, 1) of the view.
  using Plane = Eigen::Vector3d;
  struct Sample {
    Eigen::Vector3d place;  ///< column, row, 1
    double nearness;        ///< 1 / measured depth
  };
  struct ModelSample {
    Sample measured;
    double expected;  ///< 1 / depth of the model
  };

  void collect(const VisibleSurface& surface, const TiledCloud& cloud);
  void find_planes(double gate);
  std::optional<Plane> largest_plane(double gate) const;
  Plane fitted(const Plane& start, double gate) const;
  bool is_cut(const Plane& plane, double gate) const;

  std::vector<Sample> around_;
  std::vector<ModelSample> model_;
  std::vector<Plane> planes_;
};

}  // namespace lockbox
