// SPDX-License-Identifier: BSD-3-Clause
// E_free: visible surface of the model that lies where the camera saw through is pulled to the
// nearest observed surface of the object (docs/mathematics.md).
//
// Seen through means: the measurement on the sample's ray lies more than a dead zone behind it.
// Samples behind the measurement are occluded, those on pixels without depth unknown; both are
// free. The nearest observed surface is sought in the neighbourhood of the pixel, so that at an
// outline the pull is sideways.
#pragma once

#include <vector>

#include "lockbox/registration/visible_surface.hpp"

namespace lockbox {

class FreeSpaceTerm {
 public:
  /// Selects the samples that are seen through at these poses, and what each is pulled to, and adds
  /// each body's system. object: the pixels that show the object (one byte a pixel).
  /// Returns the cost relative to that of all selected samples being outliers.
  double linearize(const VisibleSurface& surface, const BodyPoses& T_camera_body,
                   const TiledCloud& cloud, const std::vector<std::uint8_t>& object,
                   const RegistrationOptions& options, double spread, const Executor& executor,
                   std::vector<BodySystem>& systems);

  /// The cost at other poses under the selection of the last linearisation.
  double cost(const BodyPoses& T_camera_body) const;

  std::size_t pulled_samples() const { return pulls_.size(); }

 private:
  /// residual = direction . (T p_body - target); direction and target in the camera's frame.
  struct Pull {
    Eigen::Vector3d p_body;
    Eigen::Vector3d target;
    Eigen::Vector3d direction;
    double inverse_variance;
    int body;
  };

  double weight_ = 1.0;
  double cut_ = 0.0;
  std::vector<std::vector<Pull>> chunk_pulls_;
  std::vector<Pull> pulls_;
};

}  // namespace lockbox
