// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "hypothesis.hpp"
#include "lockbox/initialization/initializer.hpp"
#include "lockbox/terms/low_prominence.hpp"
#include "lockbox/verification/coarse_view.hpp"
#include "lockbox/verification/verifier.hpp"
#include "overlap.hpp"
#include "point_match.hpp"
#include "surroundings.hpp"
#include "template_matching.hpp"
#include "view_score.hpp"

namespace lockbox {

/// What the stages keep: before joints are known, a low score says little, and a large side of a
/// near box explains many pixels.
struct Breadth {
  std::size_t matches_each;  ///< of one template on one region
  Selection matched;
  Selection placed;
  Selection posed;
  /// Of the poses, those that are improved by the drawing, too, before all but the best are left
  /// out.
  std::optional<Selection> improved;
  std::size_t likeliest;  ///< by their evidence: of the poses, those that are made exact
  bool is_close;          ///< for small things: judged in the finer view from the start
};

/// Turns of an answer are compared all of them, however much alike they look.
inline constexpr Selection kEachTurn{0.0, 128, 0.0, 1};

enum class Proposals {
  sides,         ///< flat sides of the model on planes of the view
  sides_closer,  ///< likewise, on planes of the finer view
  points,        ///< pairs of points
};

/// A part of the search. Each looks closer than those before.
struct Round {
  Proposals proposals;
  const Breadth* breadth;
  double enough;  ///< belief in an answer, with which the search ends
};

/// The memory of the search, and its stages in their order.
struct Initializer::Workspace {
  const ArticulatedModel& model;
  KinematicTree from_afar;  ///< the model in fewer triangles, for views of few pixels
  InitializerOptions options;
  Executor executor;
  std::optional<std::vector<HeightTemplate>> templates;  ///< made when first matched
  bool is_flat;                                          ///< most of its surface
  std::optional<BodyPairs> pairs;                        ///< made when first needed
  ModelExtent extent;
  std::vector<Eigen::Isometry3d> symmetries;  ///< of the model
  std::vector<Eigen::Isometry3d> turns;       ///< of its box, or its base, that are none of it
  Surroundings surroundings;
  Configuration held;          ///< in which locked joints stand
  std::vector<int> variables;  ///< of joints that are not locked
  std::vector<std::uint8_t> all_bodies;
  /// By worker.
  std::vector<ViewScore> scores;
  std::vector<ViewScore> halves;  ///< of a finer view
  std::vector<ArticulatedRegistration> coarse;
  std::vector<PartOfCloud> parts;
  ArticulatedRegistration fine;
  LowProminence low_prominence;
  OverlapFinder overlap;
  Verifier verifier;
  TiledCloud coarse_cloud;

  Workspace(const ArticulatedModel& articulated_model, const InitializerOptions& given,
            const Executor& workers);

  /// Standard deviations of 1/depth, 1/metre: of a pixel; of a sample of either view, and of what
  /// the object is off its model there.
  double depth_noise() const { return options.registration.noise.sigma_inverse_depth(); }
  double view_noise() const { return kMedianNoise * std::max(depth_noise(), kLeastNoise); }
  double fine_view_noise() const { return kHalfNoise * std::max(depth_noise(), kLeastNoise); }

  /// All stages but the last, round by round, until an answer is convincing. The answers of all
  /// rounds are ranked together.
  std::vector<Candidate> seek_in_rounds(const TiledCloud& cloud, const PlanarScene& scene,
                                        const CoarseView& fine_view, int most_rounds,
                                        SearchProgress& progress);
  /// What was found made exact, all joints sought once more.
  void rescan_joints(const TiledCloud& cloud, const CoarseView& fine_view, Candidate& candidate);
  /// Parts within others would push away what is seen when it is registered: of these variables,
  /// those about which the view says little yield. margins: of scan_joints() for these, or none.
  void resolve_overlap(const TiledCloud& cloud, const std::vector<int>& which,
                       const JointMargins& margins, Configuration& configuration);

 private:
  std::vector<Hypothesis> proposed(const Round& round, const PlanarScene& scene,
                                   const CoarseView& fine_view);
  /// Answers of rounds before.
  std::vector<Hypothesis> known(const std::vector<Configuration>& answers) const;
  /// The stages from place up to rank. to_beat: the most evidence of any answer up to now, nats.
  std::vector<Hypothesis> followed(const TiledCloud& cloud, std::vector<Hypothesis> hypotheses,
                                   const Breadth& breadth, double to_beat);
  void seek_turns_of_best(const TiledCloud& cloud, double& turned, std::vector<Candidate>& answers);
  /// gain: the most that evidence grows by from here on, nats.
  void leave_out_hopeless(double to_beat, double gain, std::size_t most,
                          std::vector<Hypothesis>& hypotheses);
  /// What else the object may be that was taken for this: turned to where its box is the same, or
  /// swung about what is seen most of.
  std::vector<Hypothesis> seek_turned(const TiledCloud& cloud, const Candidate& found);
  void add_swung(const TiledCloud& cloud, const Configuration& found,
                 std::vector<Hypothesis>& hypotheses);
  /// Adds what stages sought, made exact, the most convincing first.
  void assess(const TiledCloud& cloud, const std::vector<Hypothesis>& hypotheses,
              const Selection& ranked, std::vector<Candidate>& answers);
  std::vector<Hypothesis> match(const PlanarScene& scene, const Breadth& breadth);
  /// Proposals of pairs of points of the view, but for its wide planes.
  std::vector<Hypothesis> match_points(const CoarseView& view, const PlanarScene& scene,
                                       const Breadth& breadth);
  void place(std::vector<Hypothesis>& hypotheses, const Breadth& breadth);
  void pose(std::vector<Hypothesis>& hypotheses, const Breadth& breadth);
  void search_coordinates_of_each(std::vector<Hypothesis>& hypotheses);
  void fit(std::vector<Hypothesis>& hypotheses, const Breadth& breadth);
  void fit_closely(const TiledCloud& cloud, std::vector<Hypothesis>& hypotheses,
                   const Breadth& breadth);
  void add_matched(std::size_t body, const Eigen::Isometry3d& T_camera_body,
                   std::vector<Hypothesis>& hypotheses) const;
  void align_if_better(const TiledCloud& cloud, std::vector<Hypothesis>& hypotheses,
                       const Breadth& breadth);
  void align_exactly(const TiledCloud& cloud, Configuration& configuration);
  /// At full resolution. Valid until the next call.
  RegistrationResult align_finely(const TiledCloud& cloud, const Configuration& start,
                                  const AlignOptions& align_options);
  void align_coarsely(double annealing_sigma, int iterations, Configuration& configuration,
                      bool hold_joints = false);
  void search_coordinates_far(Configuration& configuration);
  void score_match(bool is_close, Hypothesis& hypothesis);
  double score_of(const Hypothesis& hypothesis, double slack, double tolerance, bool is_close);
  double score_closely(const Configuration& configuration, double slack);
  /// What evidence gains at most from a pose in the coarse view to the exact one. Unit: nats.
  /// Source: 187 was the most of 395 answers above 20 nats in 80 tuning scenes
  /// (docs/initialization.md). Doubled, more hypotheses are followed that come to nothing.
  static constexpr double kGainedFromAfar = 200.0;
  /// The same from an answer that is registered closely. Source: of the same answers three gained
  /// more than 35 (39, 40 and 71), and stayed 272, 272 and 54 behind the best; one that led gained
  /// 56. Doubled, more answers are made exact that are none.
  static constexpr double kGainedAtLast = 60.0;
  /// Objects, and the depths of the best sensors, are off by more than these err. Unit: 1/metre, a
  /// PrimeSense's noise. Source: five of ten pieces of furniture that deviated by a third of
  /// `mismatch` were not found by the noise of an ideal sensor, one is. Doubled, relief of a
  /// centimetre is lost from 1.5 m on.
  static constexpr double kLeastNoise = 0.0021;
  static constexpr double kFineSlack = 0.003;  ///< metres that surfaces may be off at last
  static constexpr double kMedianNoise = 0.6;  ///< of the noise is left in a median of 4 x 4
  static constexpr double kHalfNoise = 0.85;   ///< of 2 x 2
  ViewScore& score() { return scores[Executor::worker()]; }
};

}  // namespace lockbox
