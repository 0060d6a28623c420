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

  /// Pairs of points of the finer view, but for its wide planes.
  std::vector<Hypothesis> by_points(SearchImage& image, const Configuration& held,
                                    const Breadth& breadth);

 private:
  void score_match(SearchImage& image, const Configuration& held, bool is_close,
                   Hypothesis& hypothesis) const;

  const SoughtModel& sought_;
  StopRequest stop_request_;
  Executor executor_;
  std::optional<std::vector<HeightTemplate>> templates_;  ///< made when first matched
  std::optional<BodyPairs> pairs_;                        ///< made when first needed
};

}  // namespace lockbox
