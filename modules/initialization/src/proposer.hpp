// SPDX-License-Identifier: BSD-3-Clause
// Where the model may be: its flat sides laid onto planes of the view, or pairs of its points onto
// pairs of points.
#pragma once

#include <optional>
#include <vector>

#include "breadth.hpp"
#include "height_template.hpp"
#include "lockbox/core/stop_request.hpp"
#include "point_match.hpp"
#include "search_image.hpp"

namespace lockbox {

/// Not thread-safe. Proposing throws Stopped if that is requested.
class Proposer {
 public:
  Proposer(const SoughtModel& sought, const StopRequest& stop_request, const Executor& executor);

  /// Flat sides of the model on planes of the image, those of its own view or of the finer one.
  /// held: in which locked joints stand, and others until they are sought.
  std::vector<Hypothesis> by_sides(SearchImage& image, const PlanarScene& scene,
                                   const Configuration& held, const Breadth& breadth);

  /// Pairs of points of the finer view, but for its wide planes, as those of the body that tells
  /// most.
  std::vector<Hypothesis> by_points(SearchImage& image, const Configuration& held,
                                    const Breadth& breadth);
  /// Proposes by points of the other bodies that tell, which are held there: joints are sought from
  /// them.
  std::vector<Hypothesis> by_points_of_others(SearchImage& image, const Configuration& held,
                                              const Breadth& breadth);

 private:
  void score_match(SearchImage& image, const Configuration& held, bool is_close,
                   Hypothesis& hypothesis) const;

  std::vector<PoseVote> votes(SearchImage& image, std::size_t telling);
  std::vector<Hypothesis> scored(SearchImage& image, const Breadth& breadth,
                                 std::vector<Hypothesis> found) const;

  const SoughtModel& sought_;
  StopRequest stop_request_;
  Executor executor_;
  std::optional<std::vector<HeightTemplate>> templates_;  ///< made when first matched
  std::vector<std::size_t> telling_;                      ///< bodies, the one that tells most first
  std::vector<std::optional<BodyPairs>> pairs_;           ///< of these; made when first needed
};

}  // namespace lockbox
