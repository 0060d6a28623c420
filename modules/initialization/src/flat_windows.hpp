// SPDX-License-Identifier: BSD-3-Clause
// First guesses of the planes that a camera sees: windows of the view that are mostly flat.
#pragma once

#include <vector>

#include "inverse_depth.hpp"
#include "lockbox/core/parallel.hpp"

namespace lockbox {

/// Those samples of a window that lie in one plane.
struct FlatWindow {
  Eigen::Vector3f m;                 ///< of the plane m.p = 1, 1/metre, camera frame
  double quality;                    ///< of two planes the better has more samples, or nearer ones
  std::vector<std::size_t> samples;  ///< of the view
};

/// The best first. tolerance: how far 1/depth of a sample may be off its plane, 1/metre.
std::vector<FlatWindow> find_flat_windows(const CoarseView& view, const InverseDepth& inverse_depth,
                                          double tolerance, const Executor& executor);

}  // namespace lockbox
