// SPDX-License-Identifier: BSD-3-Clause
// Where is it? From one frame and the model alone, without a guess.
//
// Flat pieces of the scene are matched with the flat sides of the model by the relief over them;
// the best poses are judged by drawing them, refined, their joints scanned, refined together, and
// judged again by what they explain and what they contradict (docs/initialization.md).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/stop_request.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"

namespace lockbox {

struct InitializerOptions {
  RegistrationOptions registration;
  std::size_t most_candidates = 3;  ///< to be returned
  /// A search that it stops throws Stopped within some tenths of a second. The next one begins
  /// anew.
  StopRequest stop_request = nullptr;
};

/// By joint variable: by how many pixels, in a view of 320 columns, its position explains more than
/// any other that is not beside it; infinity where nothing is seen of it, or it was not sought.
using JointMargins = std::vector<double>;

/// One answer to where the model is.
struct Candidate {
  Configuration configuration;
  JointMargins margins;   ///< of the first candidate; empty for others
  double evidence = 0.0;  ///< nats, see lockbox/verification/evidence.hpp
  double belief = 0.0;    ///< the probability that it is right, see lockbox/verification/belief.hpp
  /// Metres by which the model's surface is somewhere else, in the root of the mean square over
  /// what else may be right, weighted by its probability: another answer, or none.
  double rival_distance = 0.0;
  Agreement agreement;
};

/// A configuration of which only joints were sought.
struct SoughtJoints {
  Configuration configuration;
  JointMargins margins;
};

/// Not thread-safe. The model must outlive it.
class Initializer {
 public:
  Initializer(const ArticulatedModel& model, const InitializerOptions& options,
              const Executor& executor);
  ~Initializer();
  Initializer(Initializer&&) noexcept;
  Initializer& operator=(Initializer&&) noexcept;

  /// The most convincing configurations, best first; none if nothing in view resembles the model.
  /// Locked joints stand as in `held`, without it as at rest. The same for any number of threads.
  /// Throws InputError if the cloud has no image, and Stopped if it was stopped.
  std::vector<Candidate> find(const TiledCloud& cloud,
                              const std::optional<Configuration>& held = std::nullopt);

  /// The same, but ends after the first round (docs/initialization.md), whatever it has found: a
  /// quarter of the time or less where the object is not in view. All joints are sought.
  std::vector<Candidate> glance(const TiledCloud& cloud);

  /// The joints alone, each over its whole range, the base known within a centimetre. Variables
  /// that are not listed, that are locked, or that the view says nothing about, keep their
  /// positions.
  SoughtJoints find_joints(const TiledCloud& cloud, const Configuration& start,
                           const std::vector<int>& variables);

 private:
  std::vector<Candidate> look(const TiledCloud& cloud, const std::optional<Configuration>& held,
                              bool is_thorough);

  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace lockbox
