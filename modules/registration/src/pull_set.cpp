// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/pull_set.hpp"

#include <algorithm>

namespace lockbox {
namespace {

constexpr std::size_t kMostInBlock = 256;

}  // namespace

void PullSet::assign(std::span<const FreeSpacePull> pulls, std::size_t bodies) {
  lay_out(pulls, bodies);
  for (const FreeSpacePull& pull : pulls) {
    const std::size_t i = next_[static_cast<std::size_t>(pull.body)]++;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      arrays_[px + axis][i] = static_cast<float>(pull.p_body[a]);
      arrays_[tx + axis][i] = static_cast<float>(pull.target[a]);
      arrays_[dx + axis][i] = static_cast<float>(pull.direction[a]);
    }
    arrays_[variance][i] = static_cast<float>(pull.variance);
    arrays_[direction_variance][i] = static_cast<float>(pull.direction_variance);
    arrays_[pixels][i] = static_cast<float>(pull.pixels);
  }
}

/// Makes room for the pulls of each body, and fills it with padding.
void PullSet::lay_out(std::span<const FreeSpacePull> pulls, std::size_t bodies) {
  next_.assign(bodies, 0);
  for (const FreeSpacePull& pull : pulls) ++next_[static_cast<std::size_t>(pull.body)];
  blocks_.clear();
  std::size_t end = 0;
  for (std::size_t body = 0; body < bodies; ++body) {
    const std::size_t padded = kernels::padded(next_[body]);
    next_[body] = end;
    for (std::size_t begin = 0; begin < padded; begin += kMostInBlock) {
      blocks_.push_back(
          {static_cast<int>(body), end + begin, std::min(kMostInBlock, padded - begin)});
    }
    end += padded;
  }
  for (std::vector<float>& array : arrays_) array.assign(end, 0.0F);
  arrays_[variance].assign(end, 1.0F);
}

kernels::PullSpan PullSet::span(const Block& block) const {
  const auto from = [&](std::size_t number) { return arrays_[number].data() + block.first; };
  return {{from(px), from(py), from(pz)},
          {from(tx), from(ty), from(tz)},
          {from(dx), from(dy), from(dz)},
          from(variance),
          from(direction_variance),
          from(pixels),
          block.padded};
}

}  // namespace lockbox
