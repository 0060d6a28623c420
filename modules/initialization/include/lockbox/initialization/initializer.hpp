// SPDX-License-Identifier: BSD-3-Clause
// Where is it? From one frame and the model alone, without a guess.
//
// Flat pieces of the scene are matched with the flat sides of the model by the template over them;
// the best poses are scored by drawing them, refined, their joints scanned, refined together, and
// scored again by what they explain and what they contradict (docs/initialization.md).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/stop_request.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/verification/evidence_options.hpp"

namespace lockbox {

/// How the object is sought.
struct InitializerOptions {
  RegistrationOptions registration;  ///< of the alignments that refine what is found
  EvidenceOptions evidence;          ///< by which answers are compared
  /// Answers to be returned that are apart; of each, one more may be, with other joints.
  std::size_t most_candidates = 3;
  /// A search that it stops throws Stopped within some tenths of a second. The next one begins
  /// anew.
  StopRequest stop_request = nullptr;
};

/// By joint variable: by how many pixels, in a view of 320 columns, its position explains more than
/// any other that is not beside it; infinity where nothing is seen of it, or it was not sought.
using JointMargins = std::vector<double>;
/// The margin of a joint that moves what hardly stands out of the noise, where the image does not
/// tell its position from others.
inline constexpr double kNotTold = -1.0;

/// One answer to where the model is.
struct Candidate {
  Configuration configuration;  ///< where the object may be
  JointMargins margins;         ///< of the first candidate; empty for others
  double evidence = 0.0;        ///< nats, see lockbox/verification/evidence.hpp
  /// What speaks against it, of what speaks for it; infinite where nothing does.
  double contradiction = 0.0;
  double belief = 0.0;  ///< the probability that it is right, see lockbox/verification/belief.hpp
  /// Metres by which the model's surface is somewhere else, in the root of the mean square over
  /// what else may be right, weighted by its probability: another answer, or none.
  double rival_distance = 0.0;
  /// Metres from the first candidate's surface to this one's, at the farthest corner of the model's
  /// box; 0 for one that is the same answer, or looks the same.
  double distance = 0.0;
  bool is_in_place_of_first =
      false;            ///< its middle is within the model's radius of the first one's
  Agreement agreement;  ///< how the model compares with the image there
};

/// A configuration of which only joints were sought.
struct SoughtJoints {
  Configuration configuration;  ///< the best that was found
  JointMargins margins;         ///< by how much it is better than any other
};

/// How far a search has come that goes on in later images.
struct SearchProgress {
  int rounds = 0;                      ///< that are done; 0: the next one begins anew
  std::vector<Configuration> answers;  ///< the best ones up to now
};

class LookAlikes;

/// Finds the model in a cloud without a guess. It is not thread-safe. The model must outlive it.
class Initializer {
 public:
  /// executor: its workers do the searches. look_alikes: of the model, with its locked joints, if
  /// they are known already.
  Initializer(const ArticulatedModel& model, const InitializerOptions& options,
              const Executor& executor, std::shared_ptr<const LookAlikes> look_alikes = nullptr);
  ~Initializer();
  Initializer(Initializer&&) noexcept;
  Initializer& operator=(Initializer&&) noexcept;

  /// Returns the most convincing configurations, best first; none if nothing in view resembles the
  /// model. Locked joints stand as in `held`, without it as at rest. The same for any number of
  /// threads. Throws InputError if the cloud has no image, and Stopped if it was stopped.
  std::vector<Candidate> find(const TiledCloud& cloud,
                              const std::optional<Configuration>& held = std::nullopt);

  /// Does the same in parts: at most so many rounds, of which each takes about as long as the
  /// others and looks closer than those before (docs/initialization.md), and what the rounds before
  /// have found in earlier images, registered anew. progress.rounds is 0 afterwards if the search
  /// has ended: it is convinced, or nothing is left to be tried.
  std::vector<Candidate> find_part(const TiledCloud& cloud,
                                   const std::optional<Configuration>& held, int most_rounds,
                                   SearchProgress& progress);

  /// Does the same as find(), but ends after the first round (docs/initialization.md), whatever it
  /// has found: a quarter of the time or less where the object is not in view. All joints are
  /// sought.
  std::vector<Candidate> glance(const TiledCloud& cloud);

  /// Finds the joints alone, each over its whole range, the base known within a centimetre.
  /// Variables that are not listed, that are locked, or that the view says nothing about, keep
  /// their positions.
  SoughtJoints find_joints(const TiledCloud& cloud, const Configuration& start,
                           const std::vector<int>& variables);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace lockbox
