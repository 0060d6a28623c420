// SPDX-License-Identifier: BSD-3-Clause
#include "noise_field.hpp"

#include <algorithm>
#include <cmath>

#include <numbers>

#include "lockbox/core/square.hpp"

namespace lockbox {
namespace {

// These two change bounds by less than 5 %, against nodes L apart and a blur cut off at 3.
constexpr double kSpacing = 4.0 / 3.0;  ///< of the nodes, correlation lengths
constexpr double kBlurReach = 2.5;      ///< standard deviations
// Of the residual. What is left of the information is a few hundredths of what enters.
constexpr double kTolerance = 1e-3;
constexpr int kMaximumIterations = 200;

void add_scaled(double scale, const double* __restrict from, std::size_t count,
                double* __restrict to) {
  for (std::size_t i = 0; i < count; ++i) to[i] += scale * from[i];
}

/// taps[t] taps[t - shift], 0 where one of them does not exist.
double overlap(const std::vector<double>& taps, int t, int shift) {
  const int other = t - shift;
  const bool exists = other >= 0 && other < static_cast<int>(taps.size());
  return exists ? taps[static_cast<std::size_t>(t)] * taps[static_cast<std::size_t>(other)] : 0.0;
}

}  // namespace

NoiseField::NoiseField(const SensorModel& sensor, const PinholeCamera& camera,
                       const Executor& executor)
    : executor_(executor),
      spacing_(std::max(1, static_cast<int>(std::lround(kSpacing * sensor.correlation_length)))) {
  const double width = sensor.correlation_length / std::numbers::sqrt2;
  reach_ = static_cast<int>(std::ceil(kBlurReach * width));
  margin_ = reach_ / spacing_ + 1;
  coupled_ = 2 * reach_ / spacing_;
  nodes_u_ = (camera.width - 1) / spacing_ + 1 + 2 * margin_;
  nodes_v_ = (camera.height - 1) / spacing_ + 1 + 2 * margin_;
  for (int i = -reach_; i <= reach_; ++i) {
    taps_.push_back(std::exp(-0.5 * square(i / width)));
  }
  // The variance of n: s^2 times the sum of squared taps over the nodes, along both axes.
  double squares = 0.0;
  for (const double tap : taps_) squares += square(tap) / spacing_;
  precision_ = square(squares / sensor.disparity_noise);
}

/// Row by row first, then across rows: the blur is separable.
void NoiseField::assemble(const ChannelImage& weights) {
  const int stencil = 2 * coupled_ + 1;
  ChannelImage along_rows;
  along_rows.resize(nodes_u_, weights.height, static_cast<std::size_t>(stencil));
  executor_.for_each(static_cast<std::size_t>(weights.height), [&](std::size_t row) {
    const int v = static_cast<int>(row);
    for (int node = 0; node < nodes_u_; ++node) {
      double* const sums = along_rows.at(node, v);
      const int first = (node - margin_) * spacing_ - reach_;
      for (int t = std::max(0, -first); t <= std::min(2 * reach_, weights.width - 1 - first); ++t) {
        const double weight = *weights.at(first + t, v);
        for (int d = -coupled_; d <= coupled_; ++d) {
          sums[d + coupled_] += weight * overlap(taps_, t, d * spacing_);
        }
      }
    }
  });
  const auto size = static_cast<std::size_t>(stencil);
  coupling_.resize(static_cast<std::size_t>(nodes_u_) * static_cast<std::size_t>(nodes_v_) * size *
                   size);
  executor_.for_each(static_cast<std::size_t>(nodes_v_), [&](std::size_t node_v) {
    std::vector<double> sums(size * size);
    const int first = (static_cast<int>(node_v) - margin_) * spacing_ - reach_;
    for (int node = 0; node < nodes_u_; ++node) {
      std::fill(sums.begin(), sums.end(), 0.0);
      for (int t = std::max(0, -first); t <= std::min(2 * reach_, weights.height - 1 - first);
           ++t) {
        for (int d = -coupled_; d <= coupled_; ++d) {
          add_scaled(overlap(taps_, t, d * spacing_), along_rows.at(node, first + t), size,
                     &sums[static_cast<std::size_t>(d + coupled_) * size]);
        }
      }
      std::copy(sums.begin(), sums.end(),
                coupling_.begin() +
                    static_cast<std::ptrdiff_t>((node_v * static_cast<std::size_t>(nodes_u_) +
                                                 static_cast<std::size_t>(node)) *
                                                size * size));
    }
  });
}

/// B' of an image.
void NoiseField::project(const ChannelImage& weighted, ChannelImage& projected) const {
  const std::size_t channels = weighted.channels;
  ChannelImage along_rows;
  along_rows.resize(nodes_u_, weighted.height, channels);
  executor_.for_each(static_cast<std::size_t>(weighted.height), [&](std::size_t row) {
    const int v = static_cast<int>(row);
    for (int node = 0; node < nodes_u_; ++node) {
      const int first = (node - margin_) * spacing_ - reach_;
      for (int t = std::max(0, -first); t <= std::min(2 * reach_, weighted.width - 1 - first);
           ++t) {
        add_scaled(taps_[static_cast<std::size_t>(t)], weighted.at(first + t, v), channels,
                   along_rows.at(node, v));
      }
    }
  });
  projected.resize(nodes_u_, nodes_v_, channels);
  const std::size_t row_size = static_cast<std::size_t>(nodes_u_) * channels;
  executor_.for_each(static_cast<std::size_t>(nodes_v_), [&](std::size_t row) {
    const int node_v = static_cast<int>(row);
    const int first = (node_v - margin_) * spacing_ - reach_;
    for (int t = std::max(0, -first); t <= std::min(2 * reach_, weighted.height - 1 - first); ++t) {
      add_scaled(taps_[static_cast<std::size_t>(t)], along_rows.at(0, first + t), row_size,
                 projected.at(0, node_v));
    }
  });
}

/// (1/s^2 + B' W B) x
void NoiseField::multiply(const ChannelImage& x, ChannelImage& product) const {
  const int stencil = 2 * coupled_ + 1;
  executor_.for_each(static_cast<std::size_t>(nodes_v_), [&](std::size_t row) {
    const int v = static_cast<int>(row);
    for (int u = 0; u < nodes_u_; ++u) {
      const float* const coupling =
          &coupling_[(row * static_cast<std::size_t>(nodes_u_) + static_cast<std::size_t>(u)) *
                     static_cast<std::size_t>(stencil * stencil)];
      double* const sum = product.at(u, v);
      std::fill(sum, sum + x.channels, 0.0);
      add_scaled(precision_, x.at(u, v), x.channels, sum);
      for (int dv = std::max(-coupled_, -v); dv <= std::min(coupled_, nodes_v_ - 1 - v); ++dv) {
        const float* const line = coupling + (dv + coupled_) * stencil + coupled_;
        for (int du = std::max(-coupled_, -u); du <= std::min(coupled_, nodes_u_ - 1 - u); ++du) {
          add_scaled(static_cast<double>(line[du]), x.at(u + du, v + dv), x.channels, sum);
        }
      }
    }
  });
}

/// Channel by channel.
Eigen::ArrayXd NoiseField::dot(const ChannelImage& a, const ChannelImage& b) const {
  using Channels = Eigen::Map<const Eigen::ArrayXXd>;
  const auto rows = static_cast<Eigen::Index>(a.channels);
  const auto columns = static_cast<Eigen::Index>(a.values.size() / a.channels);
  return (Channels(a.values.data(), rows, columns) * Channels(b.values.data(), rows, columns))

      .rowwise()
      .sum();
}

/// Conjugate gradients on all channels side by side.
void NoiseField::solve(const ChannelImage& right, ChannelImage& solution) const {
  using Channels = Eigen::Map<Eigen::ArrayXXd>;
  const auto rows = static_cast<Eigen::Index>(right.channels);
  const auto channels = [rows](ChannelImage& image) {
    return Channels(image.values.data(), rows,
                    static_cast<Eigen::Index>(image.values.size()) / rows);
  };
  ChannelImage residual = right;
  ChannelImage direction = right;
  ChannelImage product = right;
  solution.resize(nodes_u_, nodes_v_, right.channels);
  const Eigen::ArrayXd goal = square(kTolerance) * dot(right, right);
  Eigen::ArrayXd squares = dot(residual, residual);
  for (int i = 0; i < kMaximumIterations && (squares > goal).any(); ++i) {
    multiply(direction, product);
    // A channel without right side has nothing to solve: 0 / 0.
    const Eigen::ArrayXd curvature = dot(direction, product);
    const Eigen::ArrayXd step = (curvature > 0.0).select(squares / curvature, 0.0);
    channels(solution) += channels(direction).colwise() * step;
    channels(residual) -= channels(product).colwise() * step;
    const Eigen::ArrayXd new_squares = dot(residual, residual);
    const Eigen::ArrayXd turn = (squares > 0.0).select(new_squares / squares, 0.0);
    channels(direction) = channels(residual) + channels(direction).colwise() * turn;
    squares = new_squares;
  }
}

Eigen::MatrixXd NoiseField::lost_information(const ChannelImage& weights,
                                             const ChannelImage& weighted) {
  assemble(weights);
  ChannelImage projected;
  ChannelImage solution;
  project(weighted, projected);
  solve(projected, solution);
  const auto rows = static_cast<Eigen::Index>(weighted.channels);
  const auto columns = static_cast<Eigen::Index>(projected.values.size()) / rows;
  const Eigen::Map<const Eigen::MatrixXd> right(projected.values.data(), rows, columns);
  const Eigen::Map<const Eigen::MatrixXd> solved(solution.values.data(), rows, columns);
  const Eigen::MatrixXd lost = right * solved.transpose();
  return 0.5 * (lost + lost.transpose());
}

}  // namespace lockbox
