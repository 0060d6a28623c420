// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/configuration.hpp"
#include "lockbox/tracking/tracker_options.hpp"
#include "lockbox/verification/verifier.hpp"

namespace lockbox {

/// Asks the image of the present frame how probable it is that the object is there. All that is
/// given must outlive it.
class ImageBelief {
 public:
  ImageBelief(const KinematicTree& tree, const TiledCloud& cloud, const TrackerOptions& options,
              const Executor& executor)
      : verifier_(tree, options.evidence), cloud_(cloud), options_(options), executor_(executor) {}

  /// The probability, in [0, 1].
  double of(const Configuration& configuration);

  /// Returns the evidence for each, nats (lockbox/verification/evidence.hpp). They are rivals, of
  /// which one is right: they are compared closely (Verifier::compare()).
  std::vector<double> evidence(std::span<const Configuration> rivals);

 private:
  Verifier verifier_;
  const TiledCloud& cloud_;
  const TrackerOptions& options_;
  const Executor& executor_;
};

}  // namespace lockbox
