// SPDX-License-Identifier: BSD-3-Clause
// Where a body may be, by pairs of its oriented points: how far apart two points are, and the
// angles between their normals and the way from one to the other, are the same wherever it is. A
// pair of the scene votes for all pairs of the body that are alike (Drost et al., Model Globally,
// Match Locally, 2010).
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/stop_request.hpp"
#include "oriented_points.hpp"

namespace lockbox {

/// A pose that pairs of points speak for.
struct PoseVote {
  Eigen::Isometry3d T_camera_body;
  double votes = 0.0;
};

/// The pairs of a body's points, by what they look like.
class PointPairs {
 public:
  /// diameter: of the body; spacing: of its points; metres.
  PointPairs(std::vector<OrientedPoint> points, double diameter, double spacing);

  double spacing() const { return spacing_; }
  const std::vector<OrientedPoint>& points() const { return points_; }

  /// The poses that many pairs of scene points agree in, those with most votes first, at most
  /// `most`, apart from each other. The same for any number of threads. Throws Stopped if that is
  /// requested.
  std::vector<PoseVote> vote(const std::vector<OrientedPoint>& scene, std::size_t most,
                             const Executor& executor, const StopRequest& stop_request) const;

 private:
  /// A pair of the body: its first point, and the angle of the second about the first's normal.
  struct Entry {
    std::uint16_t point;
    std::uint8_t angle;
  };

  void fill();
  /// The poses in which that scene point is a point of the body.
  std::vector<PoseVote> vote_of(const std::vector<OrientedPoint>& scene, std::size_t reference,
                                std::vector<std::uint16_t>& sums) const;
  std::vector<PoseVote> peaks(const OrientedPoint& reference,
                              const std::vector<std::uint16_t>& sums) const;
  std::vector<PoseVote> clustered(std::vector<PoseVote> votes, std::size_t most) const;

  std::vector<OrientedPoint> points_;
  double diameter_;
  double spacing_;
  Eigen::Vector3d centre_;
  std::vector<std::uint32_t> first_;  ///< of each bin, in entries_
  std::vector<Entry> entries_;
};

}  // namespace lockbox
