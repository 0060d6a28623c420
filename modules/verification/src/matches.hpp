// SPDX-License-Identifier: BSD-3-Clause
// What contours tell that the scene and the model have in common: each plane of the model once,
// and less for a body that was free to move to where it fits.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/verification/evidence.hpp"

namespace lockbox {

/// Reuses its buffers.
class Matches {
 public:
  void clear(std::size_t cells) { told_.assign(cells, {}); }

  /// Of a cell of a contour of the scene: its share of what its line tells, nats, the body that
  /// the model shows there, and the two planes that meet in the contour.
  void set(std::size_t cell, double nats, std::int32_t body, std::pair<int, int> planes) {
    told_[cell] = {static_cast<float>(nats), body, planes};
  }

  /// Adds `matched` and `fitted` to what is known of the cells. planes: how many there are.
  void add_to(Evidence& sum, const KinematicTree& tree, int planes);

 private:
  struct Told {
    float nats = 0.0F;
    std::int32_t body = 0;
    std::pair<int, int> planes;
  };
  std::vector<Told> told_;
  std::vector<double> of_plane_;
  std::vector<double> of_body_;
};

}  // namespace lockbox
