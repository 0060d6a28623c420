// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/correspondence_set.hpp"

#include <algorithm>
#include <numeric>

namespace lockbox {
namespace {

constexpr std::size_t kMostInBlock = kernels::kMostCorrespondences;

}  // namespace

void CorrespondenceSet::begin(std::size_t chunks) {
  count_ = chunks;
  chunks_.resize(std::max(chunks_.size(), chunks));
  for (std::vector<FreeSpaceCorrespondence>& chunk : chunks_) chunk.clear();
}

std::size_t CorrespondenceSet::size() const {
  return std::accumulate(chunks_.begin(), chunks_.end(), std::size_t{0},
                         [](std::size_t sum, const auto& chunk) { return sum + chunk.size(); });
}

void CorrespondenceSet::finish(std::size_t bodies) {
  lay_out(bodies);
  for (const std::vector<FreeSpaceCorrespondence>& chunk : chunks()) {
    for (const FreeSpaceCorrespondence& correspondence : chunk) {
      const std::size_t i = next_[static_cast<std::size_t>(correspondence.body)]++;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<Eigen::Index>(axis);
        arrays_[px + axis][i] = correspondence.p_body[a];
        arrays_[tx + axis][i] = correspondence.target[a];
        arrays_[dx + axis][i] = correspondence.direction[a];
      }
      arrays_[variance][i] = correspondence.variance;
      arrays_[direction_variance][i] = correspondence.direction_variance;
      arrays_[pixels][i] = correspondence.pixels;
      tiles_[i] = correspondence.tile;
    }
  }
}

/// Makes room for the correspondences of each body.
void CorrespondenceSet::lay_out(std::size_t bodies) {
  next_.assign(bodies, 0);
  for (const std::vector<FreeSpaceCorrespondence>& chunk : chunks()) {
    for (const FreeSpaceCorrespondence& correspondence : chunk)
      ++next_[static_cast<std::size_t>(correspondence.body)];
  }
  blocks_.clear();
  std::size_t end = 0;
  for (std::size_t body = 0; body < bodies; ++body) {
    const std::size_t count = next_[body];
    next_[body] = end;
    for (std::size_t begin = 0; begin < count; begin += kMostInBlock) {
      blocks_.push_back(
          {static_cast<int>(body), end + begin, std::min(kMostInBlock, count - begin)});
    }
    end += count;
  }
  // The last correspondence's vector may reach beyond it, and what it reads there must be numbers.
  for (std::vector<float>& array : arrays_) array.resize(end + kernels::kLanes, 0.0F);
  std::fill(arrays_[variance].begin() + static_cast<std::ptrdiff_t>(end), arrays_[variance].end(),
            1.0F);
  tiles_.resize(end);
}

std::size_t CorrespondenceSet::end_of_run(std::size_t correspondence, std::size_t end) const {
  std::size_t next = correspondence + 1;
  while (next < end && tile(next) == tile(correspondence) &&
         pixels_of(next) == pixels_of(correspondence))
    ++next;
  return next;
}

kernels::CorrespondenceSpan CorrespondenceSet::span(const Block& block) const {
  const auto from = [&](std::size_t number) { return arrays_[number].data() + block.first; };
  return {{from(px), from(py), from(pz)},
          {from(tx), from(ty), from(tz)},
          {from(dx), from(dy), from(dz)},
          from(variance),
          from(direction_variance),
          from(pixels),
          block.count};
}

}  // namespace lockbox
