// SPDX-License-Identifier: BSD-3-Clause
// The views of the model that clouds are compared with.
#pragma once

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/view/predicted_view.hpp"

namespace lockbox {

/// A cloud, and a view of the model that it is compared with. Both must outlive it.
struct Comparison {
  const TiledCloud& cloud;
  PredictedView& view;  ///< drawn by whoever needs it, see Objective
  bool is_predicted;    ///< where the alignment starts: points may be averaged
};

/// Memory of views. What was drawn for a cloud lasts until forget(): an alignment that goes on in
/// the same cloud (AlignOptions::goes_on), and the measurement of the size, use it again.
struct Views {
  explicit Views(const RegistrationOptions& options);

  /// What was drawn is of another cloud.
  void forget();

  PredictedView rough;  ///< of few rays, with a few points only
  PredictedView close;  ///< with all of the point budget
  PredictedView other;  ///< of clouds that are not aligned with
  bool has_rough;       ///< whether looking roughly takes fewer points
};

}  // namespace lockbox
