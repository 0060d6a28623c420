// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/patch_likelihood.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/moved_bodies.hpp"

namespace lockbox {
namespace {

constexpr int kSamples = 3;  // along each side of a pixel
constexpr int kReach = 4;    // samples: of the jitter's density, from a pixel's centre
constexpr int kMargin = 6;   // pixels around what moves: noise goes together over a few
constexpr int kMostPixels = 40000;
constexpr double kNearest = 0.05;  // metres: what comes nearer to the camera fills the image

constexpr std::size_t kTaps = 2 * kReach + 1;
using Taps = std::array<float, kTaps>;

double square(double x) {
  return x * x;
}

/// Weights of the samples around a pixel's centre.
Taps jitter_density(double lateral_pixels) {
  Taps taps{};
  double sum = 0.0;
  for (int i = -kReach; i <= kReach; ++i) {
    const double offset = i / (kSamples * std::max(lateral_pixels, 1e-3));
    const double weight = std::exp(-0.5 * square(offset));
    taps[static_cast<std::size_t>(i + kReach)] = static_cast<float>(weight);
    sum += weight;
  }
  for (float& tap : taps) tap /= static_cast<float>(sum);
  return taps;
}

/// Of a row or column with the given number of samples, around a pixel's centre.
std::size_t sample_near(int pixel, int tap, int samples) {
  return static_cast<std::size_t>(std::clamp(kSamples * pixel + tap - kReach, 0, samples - 1));
}

PinholeCamera cropped(const PinholeCamera& camera, int left, int top, int width, int height) {
  return {width, height, camera.fx, camera.fy, camera.cx - left, camera.cy - top};
}

}  // namespace

PatchLikelihood::PatchLikelihood(const KinematicTree& tree, const SensorNoise& noise, double cut)
    : tree_(tree),
      noise_(noise),
      cut_(cut),
      covariance_(noise.depth_quadratic * std::sqrt(1.0 - square(noise.own_share)),
                  noise.correlation_pixels),
      renderer_(std::make_unique<DepthRenderer>(PinholeCamera{}, Executor(1))) {
  for (const Body& body : tree.bodies) boxes_.push_back(bounds(body.mesh));
  for (int v = 0; v < tree.variables(); ++v) moved_.push_back(moved_bodies(tree, v));
}

bool PatchLikelihood::draw(const TiledCloud& cloud, const Configuration& configuration,
                           int variable, std::span<const double> positions,
                           std::optional<std::size_t> believed) {
  positions_.assign(positions.begin(), positions.end());
  trial_ = configuration;
  const PinholeCamera& camera = cloud.camera();
  if (!frame_motion(camera, configuration, variable)) return false;
  renderer_->set_camera(
      refined(cropped(camera, frame_.left, frame_.top, frame_.width, frame_.height), kSamples));
  const auto& moved = moved_[static_cast<std::size_t>(variable)];
  means_.resize(positions_.size() * frame_.pixels());
  variances_.assign(frame_.pixels(), 0.0F);
  has_ground_.assign(frame_.pixels(), 1);
  render(configuration, moved, false, rest_);
  leave_out_what_shows_nothing();
  for (std::size_t k = 0; k < positions_.size(); ++k) {
    trial_.q[variable] = positions_[k];
    render(trial_, moved, true, moving_);
    merge_with_rest();
    blur(means(k), k == believed);
  }
  add_own_variances();
  read_measured(cloud);
  compare();
  return compared_ > 0;
}

/// The rectangle that holds what the variable moves, wherever it stands.
bool PatchLikelihood::frame_motion(const PinholeCamera& camera, const Configuration& configuration,
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
  frame_.left = bounded(seen.min().x() - kMargin, camera.width);
  frame_.top = bounded(seen.min().y() - kMargin, camera.height);
  frame_.width = bounded(seen.max().x() + kMargin + 1.0, camera.width) - frame_.left;
  frame_.height = bounded(seen.max().y() + kMargin + 1.0, camera.height) - frame_.top;
  return frame_.width > 0 && frame_.height > 0 && frame_.pixels() <= kMostPixels;
}

void PatchLikelihood::render(const Configuration& configuration,
                             const std::vector<std::uint8_t>& moved, bool of_moved,
                             RenderedDepth& image) {
  forward_kinematics(tree_, configuration, poses_);
  items_.clear();
  for (std::size_t b = 0; b < poses_.size(); ++b) {
    if ((moved[b] != 0) == of_moved) {
      items_.push_back({&tree_.bodies[b].mesh, poses_[b], static_cast<std::int16_t>(b)});
    }
  }
  renderer_->render(items_, image);
}

void PatchLikelihood::merge_with_rest() {
  samples_.resize(rest_.depth.size());
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    samples_[i] = 1.0F / std::min(rest_.depth[i], moving_.depth[i]);  // 1 / infinity = 0
  }
}

/// The mean and, if asked for, the variance of the samples around each pixel by the jitter's
/// density.
void PatchLikelihood::blur(std::span<float> means, bool with_variances) {
  const Taps taps = jitter_density(noise_.lateral_pixels);
  const auto columns = static_cast<std::size_t>(rest_.width);
  column_sums_.resize(columns);
  column_squares_.resize(columns);
  const float reference = samples_[samples_.size() / 2];  // lest squares cancel
  for (int v = 0; v < frame_.height; ++v) {
    std::fill(column_sums_.begin(), column_sums_.end(), 0.0F);
    std::fill(column_squares_.begin(), column_squares_.end(), 0.0F);
    for (std::size_t t = 0; t < kTaps; ++t) {
      const float* const row =
          &samples_[sample_near(v, static_cast<int>(t), rest_.height) * columns];
      for (std::size_t i = 0; i < columns; ++i) column_sums_[i] += taps[t] * row[i];
      for (std::size_t i = 0; with_variances && i < columns; ++i) {
        column_squares_[i] += taps[t] * (row[i] - reference) * (row[i] - reference);
      }
    }
    for (int u = 0; u < frame_.width; ++u) {
      float mean = 0.0F;
      float squares = 0.0F;
      for (std::size_t t = 0; t < kTaps; ++t) {
        const std::size_t i = sample_near(u, static_cast<int>(t), rest_.width);
        mean += taps[t] * column_sums_[i];
        squares += taps[t] * column_squares_[i];
      }
      const std::size_t pixel = frame_.index(u, v);
      const float offset = mean - reference;
      means[pixel] = mean;
      if (with_variances) variances_[pixel] = std::max(0.0F, squares - offset * offset);
    }
  }
}

/// Of each pixel's error by itself: rounding, of disparities and of depths.
void PatchLikelihood::add_own_variances() {
  const auto own = static_cast<float>(noise_.own_share * noise_.depth_quadratic);
  const std::span<const float> expected = means(0);
  for (std::size_t i = 0; i < variances_.size(); ++i) {
    const float rounding = static_cast<float>(noise_.depth_floor) * expected[i] * expected[i];
    variances_[i] += own * own + rounding * rounding;
  }
}

/// The pixels that may show a sample where nothing but what moves is drawn, or nothing.
void PatchLikelihood::leave_out_what_shows_nothing() {
  const auto first = [](int sample) {
    return (std::max(0, sample - kReach) + kSamples - 1) / kSamples;
  };
  for (int row = 0; row < rest_.height; ++row) {
    for (int column = 0; column < rest_.width; ++column) {
      if (std::isfinite(rest_.depth[rest_.index(column, row)])) continue;
      const int last_u = std::min(frame_.width - 1, (column + kReach) / kSamples);
      const int last_v = std::min(frame_.height - 1, (row + kReach) / kSamples);
      for (int v = first(row); v <= last_v; ++v) {
        for (int u = first(column); u <= last_u; ++u) has_ground_[frame_.index(u, v)] = 0;
      }
    }
  }
}

void PatchLikelihood::read_measured(const TiledCloud& cloud) {
  measured_.resize(frame_.pixels());
  auto out = measured_.begin();
  for (int v = 0; v < frame_.height; ++v) {
    const float* const row = &cloud.depth()[static_cast<std::size_t>(v + frame_.top) *
                                                static_cast<std::size_t>(cloud.camera().width) +
                                            static_cast<std::size_t>(frame_.left)];
    out = std::transform(row, row + frame_.width, out,
                         [](float depth) { return depth > 0.0F ? 1.0F / depth : 0.0F; });
  }
}

/// Gives weight to the pixels that some position explains.
void PatchLikelihood::compare() {
  weights_.assign(frame_.pixels(), 0.0F);
  compared_ = 0;
  const auto shared = static_cast<float>(square(noise_.depth_quadratic));
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    if (has_ground_[i] == 0 || !(measured_[i] > 0.0F)) continue;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < positions_.size(); ++k) {
      least = std::min(least, std::abs(measured_[i] - means_[k * weights_.size() + i]));
    }
    if (least * least > static_cast<float>(square(cut_)) * (shared + variances_[i])) continue;
    weights_[i] = 1.0F / variances_[i];
    ++compared_;
  }
  covariance_.set_weights(frame_.width, frame_.height, weights_);
}

double PatchLikelihood::chi_squared(std::size_t position) {
  residuals_.resize(frame_.pixels());
  const std::span<const float> expected = means(position);
  std::transform(measured_.begin(), measured_.end(), expected.begin(), residuals_.begin(),
                 std::minus<>());
  covariance_.solve(residuals_);
  return covariance_.chi_squared();
}

PatchLikelihood::Step PatchLikelihood::step(std::size_t below, std::size_t at, std::size_t above) {
  residuals_.resize(frame_.pixels());
  const auto run = static_cast<float>(positions_[above] - positions_[below]);
  const std::span<const float> high = means(above);
  const std::span<const float> low = means(below);
  for (std::size_t i = 0; i < residuals_.size(); ++i) residuals_[i] = (high[i] - low[i]) / run;
  const std::span<const float> pull = covariance_.solve(residuals_);
  const std::span<const float> expected = means(at);
  double information = 0.0;
  double gradient = 0.0;
  for (std::size_t i = 0; i < pull.size(); ++i) {
    information += static_cast<double>(pull[i]) * static_cast<double>(residuals_[i]);
    gradient += static_cast<double>(pull[i]) * static_cast<double>(measured_[i] - expected[i]);
  }
  return {information > 0.0 ? gradient / information : 0.0, information};
}

}  // namespace lockbox
