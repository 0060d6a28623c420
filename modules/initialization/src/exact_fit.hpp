// SPDX-License-Identifier: BSD-3-Clause
// Registrations by the whole image, and parts that stand within each other moved apart before.
#pragma once

#include <vector>

#include "lockbox/core/stop_request.hpp"
#include "lockbox/initialization/initializer.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "overlap.hpp"
#include "search_image.hpp"

namespace lockbox {

/// Not thread-safe. Whatever registers throws Stopped if that is requested.
class ExactFit {
 public:
  ExactFit(const ArticulatedModel& model, const InitializerOptions& options,
           const Executor& executor);

  RegistrationResult align(const TiledCloud& cloud, const Configuration& start,
                           const AlignOptions& align_options);
  /// How the model compares with the image just there.
  RegistrationResult compare(const TiledCloud& cloud, const Configuration& there);

  /// Moves it to where it comes to rest, unless less is explained then.
  void refine(SearchImage& image, Configuration& configuration);

  /// Parts within others would push away what is seen when it is registered: of these variables,
  /// those about which the view says little yield. margins: of scan_joints() for these, or none.
  void resolve_overlap(const TiledCloud& cloud, const std::vector<int>& variables,
                       const JointMargins& margins, Configuration& configuration);

 private:
  const KinematicTree& tree_;
  StopRequest stop_request_;
  ArticulatedRegistration registration_;
  OverlapFinder overlap_;
};

}  // namespace lockbox
