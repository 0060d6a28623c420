// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/region_likelihood.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "lockbox/core/square.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/moved_bodies.hpp"
#include "region_worker.hpp"

namespace lockbox {
namespace {

constexpr int kSamplesAlong = 3;  // along each side of a pixel
constexpr int kPatch = 16;        // pixels: more than what stands out, so that its height counts
constexpr int kReach = 4;         // samples: of the jitter's density, from a pixel's centre
constexpr int kMarginPixels = 6;  // pixels around what moves: noise goes together over a few
/// Pixels around what a joint moves; of more, nothing is said. Source: not recorded. Doubled,
/// larger parts are compared as well, which takes up to twice as long.
constexpr int kMostPixels = 40000;
constexpr double kNearest = 0.05;  // metres: what comes nearer to the camera fills the image

constexpr std::size_t kTaps = 2 * kReach + 1;  // samples along a row or column, its own included
using RegionTaps = std::array<float, kTaps>;

/// Weights of the samples around a pixel's centre.
RegionTaps region_jitter_density(double lateral_pixels) {
  RegionTaps taps{};
  double sum = 0.0;
  for (int i = -kReach; i <= kReach; ++i) {
    const double offset = i / (kSamplesAlong * std::max(lateral_pixels, 1e-3));
    const double weight = std::exp(-0.5 * square(offset));
    taps[static_cast<std::size_t>(i + kReach)] = static_cast<float>(weight);
    sum += weight;
  }
  for (float& tap : taps) tap /= static_cast<float>(sum);
  return taps;
}

/// Returns the sample of a row or column with the given number of samples, around a pixel's centre.
std::size_t sample_near(int pixel, int tap, int samples) {
  return static_cast<std::size_t>(std::clamp(kSamplesAlong * pixel + tap - kReach, 0, samples - 1));
}

PinholeCamera cropped(const PinholeCamera& camera, int left, int top, int width, int height) {
  return {width, height, camera.fx, camera.fy, camera.cx - left, camera.cy - top};
}

}  // namespace

RegionLikelihood::RegionLikelihood(const KinematicTree& tree, const SensorNoise& noise, double gate,
                                   const Executor& executor)
    : tree_(tree), lateral_pixels_(noise.lateral_pixels), gate_(gate), executor_(executor) {
  for (const Body& body : tree.bodies) boxes_.push_back(bounds(body.mesh));
  for (int v = 0; v < tree.variables(); ++v) moved_.push_back(moved_bodies(tree, v));
  for (int i = 0; i < executor.threads(); ++i) {
    workers_.push_back(std::make_unique<Worker>(noise, kPatch));
  }
}

RegionLikelihood::~RegionLikelihood() = default;
RegionLikelihood::RegionLikelihood(RegionLikelihood&&) noexcept = default;

std::span<const double> RegionLikelihood::compare(const TiledCloud& cloud,
                                                  const Configuration& configuration, int variable,
                                                  std::span<const double> positions) {
  compared_ = 0;
  positions_.assign(positions.begin(), positions.end());
  if (!frame_motion(cloud.camera(), configuration, variable)) return {};
  draw(cloud.camera(), configuration, variable);
  read_measured(cloud);
  const auto patches = static_cast<std::size_t>(frame_.width / kPatch * (frame_.height / kPatch));
  pixels_of_patch_.assign(patches, 0);
  sums_of_patch_.assign(patches * positions_.size(), 0.0);
  rises_of_patch_.assign(patches * positions_.size(), 0.0);
  executor_.for_each(patches, [&](std::size_t patch) { compare_patch(patch); });
  sum_up();
  return compared_ > 0 ? std::span<const double>(chi_squared_) : std::span<const double>();
}

void RegionLikelihood::draw(const PinholeCamera& camera, const Configuration& configuration,
                            int variable) {
  const PinholeCamera samples =
      refined(cropped(camera, frame_.left, frame_.top, frame_.width, frame_.height), kSamplesAlong);
  for (const auto& each : workers_) each->renderer.set_camera(samples);
  const auto& moved = moved_[static_cast<std::size_t>(variable)];
  means_.resize(positions_.size() * frame_.pixels());
  has_ground_.assign(frame_.pixels(), 1);
  workers_.front()->render(tree_, configuration, moved, false, rest_);
  leave_out_what_shows_nothing();
  measure_edges_at_rest(*workers_.front());
  executor_.for_each(positions_.size(), [&](std::size_t k) {
    Worker& own = worker();
    own.trial = configuration;
    own.trial.q[variable] = positions_[k];
    own.render(tree_, own.trial, moved, true, own.moving);
    own.merge_with(rest_);
    blur(own, means(k));
  });
}

/// The rectangle that holds what the variable moves, wherever it stands.
bool RegionLikelihood::frame_motion(const PinholeCamera& camera, const Configuration& configuration,
                                    int variable) {
  Eigen::AlignedBox2d seen;
  trial_ = configuration;
  for (const double position : positions_) {
    trial_.q[variable] = position;
    forward_kinematics(tree_, trial_, poses_);
    for (std::size_t b = 0; b < boxes_.size(); ++b) {
      if (moved_[static_cast<std::size_t>(variable)][b] == 0 || boxes_[b].isEmpty()) continue;
      for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d p =
            poses_[b] * boxes_[b].corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
        if (!(p.z() >= kNearest)) return false;  // nor NaN
        seen.extend(camera.project(p));
      }
    }
  }
  if (seen.isEmpty()) return false;
  const auto bounded = [](double at, int size) {
    return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
  };
  frame_.left = bounded(seen.min().x() - kMarginPixels, camera.width);
  frame_.top = bounded(seen.min().y() - kMarginPixels, camera.height);
  const auto whole_patches = [](int size) { return (size + kPatch - 1) / kPatch * kPatch; };
  frame_.width =
      whole_patches(bounded(seen.max().x() + kMarginPixels + 1.0, camera.width) - frame_.left);
  frame_.height =
      whole_patches(bounded(seen.max().y() + kMarginPixels + 1.0, camera.height) - frame_.top);
  return frame_.width > 0 && frame_.height > 0 && frame_.pixels() <= kMostPixels;
}

/// The mean of the worker's samples around each pixel by the jitter's density.
void RegionLikelihood::blur(Worker& worker, std::span<float> means) const {
  const RegionTaps taps = region_jitter_density(lateral_pixels_);
  const auto columns = static_cast<std::size_t>(rest_.width);
  worker.column_sums.resize(columns);
  for (int v = 0; v < frame_.height; ++v) {
    std::fill(worker.column_sums.begin(), worker.column_sums.end(), 0.0F);
    for (std::size_t t = 0; t < kTaps; ++t) {
      const float* const row =
          &worker.samples[sample_near(v, static_cast<int>(t), rest_.height) * columns];
      for (std::size_t i = 0; i < columns; ++i) worker.column_sums[i] += taps[t] * row[i];
    }
    for (int u = 0; u < frame_.width; ++u) {
      float mean = 0.0F;
      for (std::size_t t = 0; t < kTaps; ++t) {
        mean += taps[t] * worker.column_sums[sample_near(u, static_cast<int>(t), rest_.width)];
      }
      means[frame_.index(u, v)] = mean;
    }
  }
}

/// The variance of what pixels measure at the edges of what rests. Believing in those of what moves
/// would favour the position that they are drawn at; the others would have to pay for theirs.
void RegionLikelihood::measure_edges_at_rest(Worker& worker) {
  std::vector<float>& samples = worker.samples;
  samples.resize(rest_.depth.size());
  std::transform(rest_.depth.begin(), rest_.depth.end(), samples.begin(),
                 [](float depth) { return 1.0F / depth; });
  const float reference = samples[samples.size() / 2];  // lest squares cancel
  blur(worker, means(0));
  for (float& sample : samples) sample = (sample - reference) * (sample - reference);
  edge_variances_.resize(frame_.pixels());
  blur(worker, edge_variances_);
  for (std::size_t i = 0; i < edge_variances_.size(); ++i) {
    const float offset = means(0)[i] - reference;
    edge_variances_[i] = std::max(0.0F, edge_variances_[i] - offset * offset);
  }
}

/// The pixels that may show a sample where nothing but what moves is drawn, or nothing.
void RegionLikelihood::leave_out_what_shows_nothing() {
  const auto first = [](int sample) {
    return (std::max(0, sample - kReach) + kSamplesAlong - 1) / kSamplesAlong;
  };
  for (int row = 0; row < rest_.height; ++row) {
    for (int column = 0; column < rest_.width; ++column) {
      if (std::isfinite(rest_.depth[rest_.index(column, row)])) continue;
      const int last_u = std::min(frame_.width - 1, (column + kReach) / kSamplesAlong);
      const int last_v = std::min(frame_.height - 1, (row + kReach) / kSamplesAlong);
      for (int v = first(row); v <= last_v; ++v) {
        for (int u = first(column); u <= last_u; ++u) has_ground_[frame_.index(u, v)] = 0;
      }
    }
  }
}

void RegionLikelihood::read_measured(const TiledCloud& cloud) {
  measured_.assign(frame_.pixels(), 0.0F);
  const int columns = std::min(frame_.width, cloud.camera().width - frame_.left);
  const int rows = std::min(frame_.height, cloud.camera().height - frame_.top);
  for (int v = 0; v < rows; ++v) {
    const float* const row = &cloud.depth()[static_cast<std::size_t>(v + frame_.top) *
                                                static_cast<std::size_t>(cloud.camera().width) +
                                            static_cast<std::size_t>(frame_.left)];
    std::transform(row, row + columns, &measured_[frame_.index(0, v)],
                   [](float depth) { return depth > 0.0F ? 1.0F / depth : 0.0F; });
  }
}

/// Returns the least residual of all positions.
float RegionLikelihood::least_residual(std::size_t pixel) const {
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k < positions_.size(); ++k) {
    least = std::min(least, std::abs(measured_[pixel] - means_[k * frame_.pixels() + pixel]));
  }
  return least;
}

/// Whether some position changes what some pixel is expected to measure.
bool RegionLikelihood::differs_in_patch(int left, int top) const {
  for (int v = top; v < top + kPatch; ++v) {
    const std::size_t first = frame_.index(left, v);
    const float* const row = &means(0)[first];
    for (std::size_t k = 1; k < positions_.size(); ++k) {
      if (!std::equal(row, row + kPatch, &means(k)[first])) return true;
    }
  }
  return false;
}

/// Compares a patch by the pixels that some position explains, by themselves and given their
/// neighbours: beside some that err alike, one that is off by four standard deviations is off by
/// fifteen of its own.
void RegionLikelihood::compare_patch(std::size_t patch) {
  const auto columns = frame_.width / kPatch;
  const int left = static_cast<int>(patch) % columns * kPatch;
  const int top = static_cast<int>(patch) / columns * kPatch;
  if (!differs_in_patch(left, top)) return;
  PatchNoise& noise = worker().noise;
  noise.clear(positions_.size());
  for (int cell = 0; cell < kPatch * kPatch; ++cell) {
    const int column = cell % kPatch;
    const int row = cell / kPatch;
    const std::size_t pixel = frame_.index(left + column, top + row);
    if (has_ground_[pixel] == 0 || !(measured_[pixel] > 0.0F)) continue;
    const float own = noise.own_variance(means(0)[pixel]) + edge_variances_[pixel];
    const float least = least_residual(pixel);
    const float variance = own + noise.shared_variance();
    if (least * least > static_cast<float>(square(gate_)) * variance) continue;
    const std::span<float> residuals = noise.add(column, row, own);
    for (std::size_t k = 0; k < positions_.size(); ++k) {
      residuals[k] = measured_[pixel] - means(k)[pixel];
    }
  }
  noise.whiten();
  const std::span<double> sums(&sums_of_patch_[patch * positions_.size()], positions_.size());
  const std::span<double> rises(&rises_of_patch_[patch * positions_.size()], positions_.size());
  const auto limit = static_cast<float>(gate_);
  for (std::size_t i = 0; i < noise.count(); ++i) {
    const std::span<const float> residuals = noise.values(i);
    const bool explains = std::any_of(residuals.begin(), residuals.end(), [limit](float residual) {
      return std::abs(residual) <= limit;
    });
    if (!explains) continue;
    for (std::size_t k = 0; k < positions_.size(); ++k) {
      sums[k] += square(static_cast<double>(residuals[k]));
      rises[k] += square(static_cast<double>(residuals[k] - residuals[positions_.size() - 1]));
    }
  }
  pixels_of_patch_[patch] = static_cast<int>(noise.count());
}

/// Sums up in the order of the patches.
void RegionLikelihood::sum_up() {
  compared_ = std::accumulate(pixels_of_patch_.begin(), pixels_of_patch_.end(), 0);
  chi_squared_.assign(positions_.size(), 0.0);
  rises_.assign(positions_.size(), 0.0);
  for (std::size_t i = 0; i < sums_of_patch_.size(); ++i) {
    chi_squared_[i % positions_.size()] += sums_of_patch_[i];
    rises_[i % positions_.size()] += rises_of_patch_[i];
  }
}

}  // namespace lockbox
