// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_matching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "rows_at_once.hpp"

namespace lockbox::simulation {
namespace {

constexpr float kOtherSurface = 1.0F;  ///< pixels of disparity: more is another surface
constexpr float kHalfAPixel = 0.5F;    ///< distances between pixels are rounded
/// Along an edge, how far it grows changes over as many pixels as the texture that is matched.
constexpr double kReachLength = 8.0;
constexpr double kHoleLength = 6.0;  ///< holes are blobs of about twice as many pixels

std::vector<float> kernel_of_length(double pixels) {
  SensorModel smooth;
  smooth.correlation_length = pixels;
  return correlation_kernel(smooth);
}

/// What a normal deviate falls below with that probability.
float normal_quantile(double share) {
  double low = -10.0;
  double high = 10.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::numbers::sqrt2) < share ? low : high) = middle;
  }
  return static_cast<float>(low);
}

}  // namespace

StereoMatching::StereoMatching(const SensorModel& sensor, const PinholeCamera& camera,
                               std::uint64_t seed)
    : width_(camera.width),
      height_(camera.height),
      camera_(camera),
      baseline_(sensor.baseline),
      unit_disparity_depth_(static_cast<float>(camera.fx * sensor.baseline)),
      window_radius_(sensor.matching_window / 2),
      least_reach_(static_cast<float>(sensor.least_fattening)),
      most_reach_(static_cast<float>(sensor.most_fattening)),
      hole_threshold_(normal_quantile(sensor.hole_share)),
      reach_noise_(kernel_of_length(kReachLength), width_, height_, seed + 1),
      hole_noise_(kernel_of_length(kHoleLength), width_, height_, seed + 2) {
  const int reach = static_cast<int>(std::floor(most_reach_ + kHalfAPixel));
  for (int dv = -reach; dv <= reach; ++dv) {
    for (int du = -reach; du <= reach; ++du) {
      const float distance = std::hypot(static_cast<float>(du), static_cast<float>(dv));
      if (distance > 0.0F && distance <= most_reach_ + kHalfAPixel)
        offsets_.push_back({du, dv, distance});
    }
  }
  std::stable_sort(offsets_.begin(), offsets_.end(),
                   [](const Offset& a, const Offset& b) { return a.distance < b.distance; });
}

std::size_t StereoMatching::index(int u, int v) const {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(u);
}

float StereoMatching::disparity_at(const std::vector<float>& disparity, int u, int v) const {
  return disparity[index(std::clamp(u, 0, width_ - 1), std::clamp(v, 0, height_ - 1))];
}

/// A window whose texture is mostly of what is in front is matched where that is. reach: noise.
void StereoMatching::fatten_row(int v, const std::vector<float>& reach) {
  for (int u = 0; u < width_; ++u) {
    const float here = disparity_[index(u, v)];
    // Uniform between the least and the most, by the distribution of the noise.
    const double share =
        0.5 * std::erfc(-reach[static_cast<std::size_t>(u)] / std::numbers::sqrt2_v<float>);
    const float own_reach = least_reach_ + (most_reach_ - least_reach_) * static_cast<float>(share);
    float matched = shadow_.covers(index(u, v)) ? 0.0F : here;
    for (const Offset& offset : offsets_) {
      if (offset.distance > own_reach + kHalfAPixel) break;
      const float beside = disparity_at(disparity_, u + offset.du, v + offset.dv);
      if (beside <= here + kOtherSurface) continue;
      matched = beside;
      break;
    }
    fattened_[index(u, v)] = matched;
  }
}

/// The mean over the window, as far as it is of the same surface.
void StereoMatching::average_row(int v, const std::vector<float>& holes) {
  for (int u = 0; u < width_; ++u) {
    const float here = fattened_[index(u, v)];
    float& depth = matched_.depth[index(u, v)];
    depth = std::numeric_limits<float>::infinity();
    if (here <= 0.0F || holes[static_cast<std::size_t>(u)] < hole_threshold_) continue;
    float sum = 0.0F;
    int count = 0;
    for (int dv = -window_radius_; dv <= window_radius_; ++dv) {
      for (int du = -window_radius_; du <= window_radius_; ++du) {
        const float beside = disparity_at(fattened_, u + du, v + dv);
        if (beside <= 0.0F || std::abs(beside - here) > kOtherSurface) continue;
        sum += beside;
        ++count;
      }
    }
    depth = unit_disparity_depth_ * static_cast<float>(count) / sum;
  }
}

const RenderedDepth& StereoMatching::match(const RenderedDepth& clean, std::uint64_t frame,
                                           const NormalTable& normal, const Executor& executor) {
  shadow_.cast(clean, camera_, baseline_, executor);
  reach_noise_.generate(frame, normal, executor);
  hole_noise_.generate(frame, normal, executor);
  disparity_.resize(clean.depth.size());
  std::transform(clean.depth.begin(), clean.depth.end(), disparity_.begin(),
                 [this](float z) { return unit_disparity_depth_ / z; });
  fattened_.resize(disparity_.size());
  matched_ = {width_, height_, std::move(matched_.depth), {}, {0, 0, width_, height_}};
  matched_.depth.resize(disparity_.size());
  const auto for_each_row = [&](const CorrelatedNoise& noise, const auto& work) {
    executor.for_each_chunk(static_cast<std::size_t>(height_), kRowsAtOnce,
                            [&](std::size_t begin, std::size_t end, std::size_t) {
                              std::vector<float> values;
                              for (std::size_t v = begin; v < end; ++v) {
                                noise.row(static_cast<int>(v), values);
                                work(static_cast<int>(v), values);
                              }
                            });
  };
  for_each_row(reach_noise_, [this](int v, const auto& reach) { fatten_row(v, reach); });
  for_each_row(hole_noise_, [this](int v, const auto& holes) { average_row(v, holes); });
  return matched_;
}

}  // namespace lockbox::simulation
