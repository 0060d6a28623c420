// SPDX-License-Identifier: BSD-3-Clause
#include "block_sampler.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

/// What is excluded must be excluded in spite of rounding.
constexpr double kRounding = 1.0001;

constexpr std::array<std::size_t, 3> kStrides = {1, kBlockSamples, kBlockSamples* kBlockSamples};

Eigen::Vector3i sample_at(std::size_t offset) {
  const auto o = static_cast<int>(offset);
  return {o % kBlockSamples, o / kBlockSamples % kBlockSamples,
          o / (kBlockSamples * kBlockSamples)};
}

}  // namespace

BlockSampler::BlockSampler(const FineLayout& layout, const TriangleTree& tree,
                           const WindingTree& winding, const std::vector<std::uint8_t>& open)
    : layout_(layout),
      tree_(tree),
      winding_(winding),
      open_(open),
      bounds_(tree.nodes().front().box) {}

const BlockSampler::Distances& BlockSampler::sample(std::size_t block) {
  first_ = layout_.first_sample(block);
  const double diagonal = std::sqrt(3.0) * kBlockCells * layout_.voxel;
  const Eigen::Vector3d middle = layout_.middle(first_, kBlockCells);
  candidates_.clear();
  tree_.collect_within(middle, kRounding * (tree_.distance(middle) + diagonal), candidates_);
  set_distances();
  set_signs(std::none_of(candidates_.begin(), candidates_.end(),
                         [&](std::uint32_t slot) { return open_[slot] != 0; }));
  return distances_;
}

void BlockSampler::set_distances() {
  constexpr std::size_t kFew = 12;
  std::uint32_t nearest = candidates_.front();
  for (std::size_t i = 0; i < distances_.size(); ++i) {
    const Eigen::Vector3d p = layout_.position(first_ + sample_at(i));
    distances_[i] =
        candidates_.size() <= kFew ? distance_to_candidates(p) : tree_.distance_beside(p, nearest);
  }
}

double BlockSampler::distance_to_candidates(const Eigen::Vector3d& p) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t slot : candidates_) {
    nearest = std::min(nearest, squared_distance(p, tree_.corners()[slot]));
  }
  return std::sqrt(nearest);
}

void BlockSampler::set_signs(bool is_closed) {
  visited_.fill(0);
  for (std::size_t seed = 0; seed < distances_.size(); ++seed) {
    if (visited_[seed] != 0) {
      continue;
    }
    region_.assign(1, seed);
    visited_[seed] = 1;
    if (is_closed) {
      join_region();
    }
    // The sample farthest from the surface is the surest.
    const auto surest = *std::max_element(
        region_.begin(), region_.end(),
        [&](std::size_t a, std::size_t b) { return distances_[a] < distances_[b]; });
    if (is_inside(surest)) {
      for (const std::size_t sample : region_) {
        distances_[sample] = -distances_[sample];
      }
    }
  }
}

void BlockSampler::join_region() {
  // Distances may be a thousandth too large.
  const double clearance = 1.01 * layout_.voxel;
  const auto join = [&](std::size_t from, std::size_t to) {
    if (visited_[to] == 0 && distances_[from] + distances_[to] > clearance) {
      visited_[to] = 1;
      region_.push_back(to);
    }
  };
  for (std::size_t i = 0; i < region_.size(); ++i) {
    const Eigen::Vector3i s = sample_at(region_[i]);
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t stride = kStrides[static_cast<std::size_t>(axis)];
      if (s[axis] > 0) {
        join(region_[i], region_[i] - stride);
      }
      if (s[axis] < kBlockCells) {
        join(region_[i], region_[i] + stride);
      }
    }
  }
}

bool BlockSampler::is_inside(std::size_t sample) const {
  const Eigen::Vector3d p = layout_.position(first_ + sample_at(sample));
  return bounds_.contains(p) && winding_.is_inside(p);
}

}  // namespace lockbox
