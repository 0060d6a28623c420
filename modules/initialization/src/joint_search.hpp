// SPDX-License-Identifier: BSD-3-Clause
// The joints of an object that is known to be there: what stands before it says nothing about them.
#pragma once

#include <vector>

#include "assessment.hpp"
#include "exact_fit.hpp"
#include "lockbox/initialization/initializer.hpp"
#include "lockbox/terms/low_prominence.hpp"
#include "search_image.hpp"

namespace lockbox {

/// Not thread-safe. What is sought, and the fit, must outlive it. Searches throw Stopped if that is
/// requested.
class JointSearch {
 public:
  JointSearch(const SoughtModel& sought, const InitializerOptions& options, const ViewNoise& noise,
              ExactFit& exact, const Executor& executor);

  /// Seeks all joints of an answer once more, then makes all of it exact. A joint of a part that is
  /// mostly hidden is told only if evidence speaks for its position against the others.
  void rescan(SearchImage& image, Assessment& assessment, Candidate& answer);

  /// These variables, each over its whole range, around a base that is known.
  SoughtJoints find(const TiledCloud& cloud, const Configuration& start,
                    const std::vector<int>& variables);

 private:
  void doubt_hidden(SearchImage& image, Assessment& assessment,
                    const std::vector<std::vector<double>>& peaks, Candidate& answer);

  const SoughtModel& sought_;
  InitializerOptions options_;
  Executor executor_;
  ExactFit& exact_;
  ViewScore coarse_;
  ViewScore fine_;
  LowProminence low_prominence_;
};

}  // namespace lockbox
