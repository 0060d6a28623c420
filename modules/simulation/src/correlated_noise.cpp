// SPDX-License-Identifier: BSD-3-Clause
#include "correlated_noise.hpp"

#include <algorithm>
#include <utility>

#include "rows_at_once.hpp"

namespace lockbox::simulation {
namespace {

constexpr std::uint64_t kNoisePurpose = 1;  ///< tells this use of the seed from others

void accumulate(const float* __restrict values, float weight, std::size_t count,
                float* __restrict sum) {
  for (std::size_t i = 0; i < count; ++i) {
    sum[i] += weight * values[i];
  }
}

}  // namespace

CorrelatedNoise::CorrelatedNoise(std::vector<float> kernel, int width, int height,
                                 std::uint64_t seed)
    : kernel_(std::move(kernel)),
      width_(static_cast<std::size_t>(width)),
      rows_(static_cast<std::size_t>(height) + kernel_.size() - 1),
      seed_(seed),
      filtered_(rows_ * width_) {}

void CorrelatedNoise::generate(std::uint64_t frame, const NormalTable& normal,
                               const Executor& executor) {
  executor.for_each_chunk(rows_, kRowsAtOnce, [&](std::size_t begin, std::size_t end, std::size_t) {
    std::vector<float> white(width_ + kernel_.size() - 1);
    for (std::size_t row = begin; row < end; ++row) {
      RandomStream random(seed_, frame, row, kNoisePurpose);
      for (std::size_t i = 0; i < white.size(); i += 5) {
        const std::uint64_t bits = random.next();
        for (std::size_t k = 0; k < std::min<std::size_t>(5, white.size() - i); ++k) {
          white[i + k] = normal(bits >> (12U * k));
        }
      }
      float* out = &filtered_[row * width_];
      std::fill(out, out + width_, 0.0F);
      for (std::size_t tap = 0; tap < kernel_.size(); ++tap) {
        accumulate(&white[tap], kernel_[tap], width_, out);
      }
    }
  });
}

void CorrelatedNoise::row(int v, std::vector<float>& noise) const {
  noise.assign(width_, 0.0F);
  for (std::size_t tap = 0; tap < kernel_.size(); ++tap) {
    accumulate(&filtered_[(static_cast<std::size_t>(v) + tap) * width_], kernel_[tap], width_,
               noise.data());
  }
}

}  // namespace lockbox::simulation
