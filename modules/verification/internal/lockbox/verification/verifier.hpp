// SPDX-License-Identifier: BSD-3-Clause
// Is the object there? What an image says for a configuration, against the scene without it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/configuration.hpp"
#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/sensor/sensor_noise.hpp"
#include "lockbox/verification/evidence.hpp"
#include "lockbox/verification/evidence_options.hpp"

namespace lockbox {

/// Not thread-safe. The tree must outlive it.
class Verifier {
 public:
  explicit Verifier(const KinematicTree& tree, const EvidenceOptions& options = {});
  ~Verifier();
  Verifier(Verifier&&) noexcept;
  Verifier& operator=(Verifier&&) noexcept;

  /// What the evidence is sought in from now on. sensor: how its noise grows with the depth; how
  /// large it is beside neighbours is measured in the cloud itself.
  void look_at(const TiledCloud& cloud, const SensorNoise& sensor, const Executor& executor);

  /// Returns the evidence in the image looked at last.
  Evidence evidence(const Configuration& configuration);

  /// Returns the lesser of that and of the same with the joints that stand within what built
  /// objects are off by (EvidenceOptions::contour_tolerance) of an end of their range put there: a
  /// gap that shows may be the object's, and not the joint's.
  Evidence evidence_within_tolerance(const Configuration& configuration);

  /// Returns the evidence of answers, nats, of which one is right, as far as cells of several
  /// widths agree: those of the usual one, and those by which as much or more speaks for an answer.
  /// Their least difference from the best counts, none if some are for another. (Narrower cells
  /// tell more, as long as they err by themselves; where a sensor errs alike over more, they show
  /// contours that are none, and speak for little.) Those of a width begin at several pixels. What
  /// was looked at stays. The same tolerance as before applies. answers: one at least.
  std::vector<double> compare(const TiledCloud& cloud, const SensorNoise& sensor,
                              const Executor& executor, std::span<const Configuration> answers);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace lockbox
