// SPDX-License-Identifier: BSD-3-Clause
// Hypotheses brought to where they explain most, closer from stage to stage
// (docs/initialization.md, "Scored by drawing"). Each stage keeps the best.
#pragma once

#include <vector>

#include "breadth.hpp"
#include "exact_fit.hpp"
#include "lockbox/core/stop_request.hpp"
#include "search_image.hpp"

namespace lockbox {

/// Not thread-safe. All stages throw Stopped if that is requested.
class Refinement {
 public:
  /// What is sought, and the fit, must outlive it.
  Refinement(const SoughtModel& sought, const InitializerOptions& options, ExactFit& exact,
             const Executor& executor);

  /// Base poses made exact as far as the known bodies tell, and a glance at the joints.
  void place(SearchImage& image, const Breadth& breadth, std::vector<Hypothesis>& hypotheses);
  /// All joints sought over their ranges, then moved together with the base.
  void pose(SearchImage& image, const Breadth& breadth, std::vector<Hypothesis>& hypotheses);
  /// Base and joints together, in the coarse view.
  void fit(SearchImage& image, const Breadth& breadth, std::vector<Hypothesis>& hypotheses);
  /// Fits at full resolution.
  void fit_closely(SearchImage& image, const Breadth& breadth, std::vector<Hypothesis>& hypotheses);

 private:
  void align_coarsely(SearchImage& image, const AlignOptions& align_options,
                      Configuration& configuration);
  void search_coordinates_far(SearchImage& image, Configuration& configuration) const;
  void search_coordinates_of_each(SearchImage& image, std::vector<Hypothesis>& hypotheses);
  void align_if_better(SearchImage& image, const Breadth& breadth,
                       std::vector<Hypothesis>& hypotheses);

  const SoughtModel& sought_;
  StopRequest stop_request_;
  Executor executor_;
  ExactFit& exact_;
  std::vector<ArticulatedRegistration> coarse_;  ///< by worker
};

}  // namespace lockbox
