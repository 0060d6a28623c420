// SPDX-License-Identifier: BSD-3-Clause
#include "point_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lockbox {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
/// Bins of an angle between directions, 15 degrees each: what noise does to normals of a few
/// samples. Doubled in number, most pairs miss the bins in which they are sought; halved, boxes
/// look like all else.
constexpr int kAngles = 12;
/// Bins of a distance up to the diameter: about as wide as points are apart. Doubled in number,
/// pairs miss theirs.
constexpr int kDistances = 18;
/// Bins of a turn about a normal, 12 degrees each; see kAngles.
constexpr int kTurns = 30;
constexpr std::size_t kBins = static_cast<std::size_t>(kDistances) * kAngles * kAngles * kAngles;
/// Points of the scene that are taken for the body's, evenly chosen: one in view of 5 cm at 1 m has
/// a dozen of them. Doubled, voting takes twice as long.
constexpr std::size_t kMostReferences = 700;
constexpr std::size_t kPeaks = 3;  // of one of them
/// Poses that are one, as far as bins tell: in shares of the diameter, and radians.
constexpr double kNear = 0.1;
constexpr double kNearAngle = 0.3;
constexpr std::size_t kMostClusters = 1500;  // bounds the time that it takes to make them

/// What a pair of points looks like from anywhere; bins, with fractions.
using Feature = std::array<float, 4>;

float angle_between(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Returns the feature of two points whose distance is in (0, reach).
Feature feature(const OrientedPoint& a, const OrientedPoint& b, float reach) {
  const Eigen::Vector3f way = b.position - a.position;
  const float distance = way.norm();
  constexpr float kStep = kAngles / kPi;
  return {distance / reach * kDistances, kStep * angle_between(a.normal, way),
          kStep * angle_between(b.normal, way), kStep * angle_between(a.normal, b.normal)};
}

std::size_t bin(const std::array<int, 4>& at) {
  std::size_t index = static_cast<std::size_t>(at[0]);
  for (std::size_t i = 1; i < 4; ++i) index = index * kAngles + static_cast<std::size_t>(at[i]);
  return index;
}

constexpr int bins_of(std::size_t dimension) {
  return dimension == 0 ? kDistances : kAngles;
}

/// The bin in which it is and, in each dimension, the one beside it that is nearest.
template <typename Visit>
void for_bins_around(const Feature& feature, const Visit& visit) {
  std::array<int, 4> here{};
  std::array<int, 4> beside{};
  for (std::size_t i = 0; i < 4; ++i) {
    here[i] = std::min(static_cast<int>(feature[i]), bins_of(i) - 1);
    const float share = feature[i] - static_cast<float>(here[i]);
    // The neighbour on the nearer side of the middle.
    beside[i] = std::clamp(share < 0.5F ? here[i] - 1 : here[i] + 1, 0, bins_of(i) - 1);
  }
  // Here or beside in each of four dimensions.
  for (unsigned corner = 0; corner < 16; ++corner) {
    std::array<int, 4> at = here;
    bool is_new = true;
    for (std::size_t i = 0; i < 4; ++i) {
      if ((corner >> i & 1U) == 0) continue;
      is_new &= beside[i] != here[i];
      at[i] = beside[i];
    }
    if (is_new) visit(bin(at));
  }
}

/// The point in the origin, its normal along x.
Eigen::Isometry3f local_frame(const OrientedPoint& point) {
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.linear() =
      Eigen::Quaternionf::FromTwoVectors(point.normal, Eigen::Vector3f::UnitX()).toRotationMatrix();
  T.translation() = -(T.linear() * point.position);
  return T;
}

/// Returns the turn of the point about x, radians in (-pi, pi].
float turn_of(const Eigen::Isometry3f& T_local, const Eigen::Vector3f& point) {
  const Eigen::Vector3f p = T_local * point;
  return std::atan2(p.z(), p.y());
}

int turn_bin(float angle) {
  const int turn = static_cast<int>(std::floor((angle / (2.0F * kPi) + 1.0F) * kTurns));
  return turn % kTurns;
}

}  // namespace

PointPairs::PointPairs(std::vector<OrientedPoint> points, double diameter, double spacing)
    : points_(std::move(points)), diameter_(diameter), spacing_(spacing) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const OrientedPoint& point : points_) sum += point.position;
  centre_ = points_.empty()
                ? Eigen::Vector3d::Zero()
                : Eigen::Vector3d((sum / static_cast<float>(points_.size())).cast<double>());
  fill();
}

/// Counts the entries of each bin first, then puts them there.
void PointPairs::fill() {
  const auto reach = static_cast<float>(diameter_);
  const auto for_pairs = [&](const auto& visit) {
    for (std::size_t a = 0; a < points_.size(); ++a) {
      const Eigen::Isometry3f T = local_frame(points_[a]);
      for (std::size_t b = 0; b < points_.size(); ++b) {
        const float distance = (points_[b].position - points_[a].position).norm();
        if (a == b || !(distance > 0.0F) || distance >= reach) continue;
        const Entry entry{static_cast<std::uint16_t>(a),
                          static_cast<std::uint8_t>(turn_bin(turn_of(T, points_[b].position)))};
        for_bins_around(feature(points_[a], points_[b], reach),
                        [&](std::size_t at) { visit(at, entry); });
      }
    }
  };
  first_.assign(kBins + 1, 0);
  for_pairs([&](std::size_t at, const Entry&) { ++first_[at + 1]; });
  for (std::size_t i = 0; i < kBins; ++i) first_[i + 1] += first_[i];
  entries_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_pairs([&](std::size_t at, const Entry& entry) { entries_[next[at]++] = entry; });
}

std::vector<PoseVote> PointPairs::vote(const std::vector<OrientedPoint>& scene, std::size_t most,
                                       const Executor& executor,
                                       const StopRequest& stop_request) const {
  const std::size_t step = scene.size() / kMostReferences + 1;
  const std::size_t references = (scene.size() + step - 1) / step;
  std::vector<std::vector<PoseVote>> found(references);
  std::vector<std::vector<std::uint16_t>> sums(static_cast<std::size_t>(executor.threads()));
  executor.for_each(references, [&](std::size_t i) {
    stop_if(stop_request);
    found[i] = vote_of(scene, i * step, sums[Executor::worker()]);
  });
  std::vector<PoseVote> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return clustered(std::move(all), most);
}

std::vector<PoseVote> PointPairs::vote_of(const std::vector<OrientedPoint>& scene,
                                          std::size_t reference,
                                          std::vector<std::uint16_t>& sums) const {
  const OrientedPoint& here = scene[reference];
  const Eigen::Isometry3f T = local_frame(here);
  const auto reach = static_cast<float>(diameter_);
  sums.assign(points_.size() * kTurns, 0);
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const float squared = (scene[i].position - here.position).squaredNorm();
    if (i == reference || !(squared > 0.0F) || squared >= reach * reach) continue;
    const Feature seen = feature(here, scene[i], reach);
    std::array<int, 4> at{};
    for (std::size_t d = 0; d < 4; ++d) {
      at[d] = std::min(static_cast<int>(seen[d]), bins_of(d) - 1);
    }
    const std::size_t index = bin(at);
    if (first_[index] == first_[index + 1]) continue;
    const int turn = turn_bin(turn_of(T, scene[i].position));
    for (std::uint32_t e = first_[index]; e < first_[index + 1]; ++e) {
      const int difference = turn - entries_[e].angle;
      const int about = difference < 0 ? difference + kTurns : difference;
      ++sums[static_cast<std::size_t>(entries_[e].point) * kTurns +
             static_cast<std::size_t>(about)];
    }
  }
  return peaks(here, sums);
}

/// Returns the best of the best turns of each point of the body. A turn is where its bin and the
/// one after it, into which it may fall as well, have most votes together.
std::vector<PoseVote> PointPairs::peaks(const OrientedPoint& reference,
                                        const std::vector<std::uint16_t>& sums) const {
  struct Peak {
    std::size_t point;
    int turn;
    int votes;
  };
  std::vector<Peak> best;
  for (std::size_t point = 0; point < points_.size(); ++point) {
    Peak peak{point, 0, 0};
    for (int turn = 0; turn < kTurns; ++turn) {
      const int votes = sums[point * kTurns + static_cast<std::size_t>(turn)] +
                        sums[point * kTurns + static_cast<std::size_t>((turn + 1) % kTurns)];
      if (votes > peak.votes) peak = {point, turn, votes};
    }
    if (peak.votes > 0) best.push_back(peak);
  }
  const auto end = best.begin() + static_cast<std::ptrdiff_t>(std::min(kPeaks, best.size()));
  std::partial_sort(best.begin(), end, best.end(), [](const Peak& a, const Peak& b) {
    return a.votes != b.votes ? a.votes > b.votes : a.point < b.point;
  });
  std::vector<PoseVote> poses;
  const Eigen::Isometry3f back = local_frame(reference).inverse();
  for (auto peak = best.begin(); peak != end; ++peak) {
    // A difference of bins is that of their lower edges; the peak is two bins wide.
    const float angle = 2.0F * kPi * (static_cast<float>(peak->turn) + 0.5F) / kTurns;
    const Eigen::Isometry3f pose = back * Eigen::AngleAxisf(angle, Eigen::Vector3f::UnitX()) *
                                   local_frame(points_[peak->point]);
    poses.push_back(
        {Eigen::Isometry3d(pose.matrix().cast<double>()), static_cast<double>(peak->votes)});
  }
  return poses;
}

/// Votes for one pose within what bins tell apart, together.
std::vector<PoseVote> PointPairs::clustered(std::vector<PoseVote> votes, std::size_t most) const {
  const auto by_votes = [](const PoseVote& a, const PoseVote& b) { return a.votes > b.votes; };
  std::stable_sort(votes.begin(), votes.end(), by_votes);
  std::vector<PoseVote> clusters;
  std::vector<Eigen::Vector3d> places;
  const double least_trace = 1.0 + 2.0 * std::cos(kNearAngle);
  for (const PoseVote& vote : votes) {
    const Eigen::Vector3d place = vote.T_camera_body * centre_;
    bool is_new = true;
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      if ((places[c] - place).norm() > kNear * diameter_) continue;
      const double trace =
          clusters[c].T_camera_body.linear().cwiseProduct(vote.T_camera_body.linear()).sum();
      if (trace < least_trace) continue;
      clusters[c].votes += vote.votes;
      is_new = false;
    }
    if (is_new && clusters.size() < kMostClusters) {
      clusters.push_back(vote);
      places.push_back(place);
    }
  }
  std::stable_sort(clusters.begin(), clusters.end(), by_votes);
  clusters.resize(std::min(clusters.size(), most));
  return clusters;
}

}  // namespace lockbox
