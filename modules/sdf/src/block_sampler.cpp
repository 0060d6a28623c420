// SPDX-License-Identifier: BSD-3-Clause
#include "block_sampler.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

/// What is excluded must be excluded in spite of rounding.
constexpr double kRounding = 1.0001;

constexpr std::array<std::size_t, 3> kStrides = {1, kBlockSamples, kBlockSamples* kBlockSamples};

std::size_t offset_of(const Eigen::Array3i& sample) {
  return static_cast<std::size_t>(sample.x()) * kStrides[0] +
         static_cast<std::size_t>(sample.y()) * kStrides[1] +
         static_cast<std::size_t>(sample.z()) * kStrides[2];
}

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
  Slots candidates;
  tree_.collect_within(middle, kRounding * (tree_.distance(middle) + diagonal), candidates);
  set_distances({Eigen::Array3i::Zero(), Eigen::Array3i::Constant(kBlockSamples)}, candidates);
  set_signs(std::none_of(candidates.begin(), candidates.end(),
                         [&](std::uint32_t slot) { return open_[slot] != 0; }));
  return distances_;
}

void BlockSampler::set_distances(const Range& range, const Slots& candidates) {
  constexpr std::size_t kFew = 3;
  constexpr std::size_t kMany = 64;
  const Eigen::Array3i size = range.end - range.begin;
  if (candidates.size() <= kFew || size.maxCoeff() <= 2) {
    for_each_sample(range, [&](const Eigen::Vector3d& p) { return distance(p, candidates); });
    return;
  }
  const Eigen::Array3i middle = range.begin + (size + 1) / 2;
  for (int eighth = 0; eighth < 8; ++eighth) {
    Range part = range;
    for (int axis = 0; axis < 3; ++axis) {
      (((eighth >> axis) & 1) != 0 ? part.begin : part.end)[axis] = middle[axis];
    }
    if ((part.begin >= part.end).any()) {
      continue;
    }
    const Slots remaining = nearest_candidates(part, candidates);
    if (remaining.size() > kMany && remaining.size() > candidates.size() / 2) {
      // Far from the surface, and in the middle of round bodies, dividing does not help.
      for_each_sample(part, [&](const Eigen::Vector3d& p) { return tree_.distance(p); });
    } else {
      set_distances(part, remaining);
    }
  }
}

BlockSampler::Slots BlockSampler::nearest_candidates(const Range& range,
                                                     const Slots& candidates) const {
  const Eigen::Vector3i size = (range.end - range.begin).matrix();
  const Eigen::Vector3d half =
      0.5 * layout_.voxel * (size - Eigen::Vector3i::Ones()).cast<double>();
  const Eigen::Vector3d middle = layout_.position(first_ + range.begin.matrix()) + half;
  std::vector<double> squared(candidates.size());
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    squared[i] = squared_distance(middle, tree_.corners()[candidates[i]]);
    nearest = std::min(nearest, squared[i]);
  }
  const double reach = kRounding * (std::sqrt(nearest) + 2.0 * half.norm());
  Slots remaining;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (squared[i] <= reach * reach) {
      remaining.push_back(candidates[i]);
    }
  }
  return remaining;
}

double BlockSampler::distance(const Eigen::Vector3d& p, const Slots& candidates) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t slot : candidates) {
    nearest = std::min(nearest, squared_distance(p, tree_.corners()[slot]));
  }
  return std::sqrt(nearest);
}

template <typename Distance>
void BlockSampler::for_each_sample(const Range& range, Distance&& distance_at) {
  Eigen::Array3i s;
  for (s.z() = range.begin.z(); s.z() < range.end.z(); ++s.z()) {
    for (s.y() = range.begin.y(); s.y() < range.end.y(); ++s.y()) {
      for (s.x() = range.begin.x(); s.x() < range.end.x(); ++s.x()) {
        distances_[offset_of(s)] = distance_at(layout_.position(first_ + s.matrix()));
      }
    }
  }
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
