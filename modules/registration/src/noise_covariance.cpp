// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/noise_covariance.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lockbox {
namespace {

constexpr double kReach = 3.0;        // correlation lengths
constexpr double kLeastLength = 0.1;  // pixels: as good as none
constexpr float kTolerance = 1e-4F;   // of the squared right side
constexpr int kMostSteps = 60;

Eigen::Map<const Eigen::ArrayXf> whole(std::span<const float> image) {
  return {image.data(), static_cast<Eigen::Index>(image.size())};
}

}  // namespace

NoiseCovariance::NoiseCovariance(double sigma, double length) {
  const double clamped = std::max(length, kLeastLength);
  const int reach = static_cast<int>(std::ceil(kReach * clamped));
  for (int i = 0; i <= reach; ++i) {
    taps_.push_back(static_cast<float>(sigma * std::exp(-0.5 * i * i / (clamped * clamped))));
  }
}

void NoiseCovariance::set_weights(int width, int height, std::span<const float> weights) {
  layout_ = {static_cast<std::size_t>(width), static_cast<std::size_t>(height), taps_.size() - 1};
  for (auto* buffer : {&padded_, &along_rows_, &shared_}) buffer->assign(layout_.size(), 0.0F);
  roots_ = whole(weights).sqrt();
  estimate_.setZero(roots_.size());
  product_.resize(roots_.size());
}

/// (1 + W^1/2 sigma^2 R W^1/2) image
void NoiseCovariance::multiply(const Eigen::ArrayXf& image, Eigen::ArrayXf& product) {
  const auto width = static_cast<Eigen::Index>(layout_.columns);
  for (std::size_t v = 0; v < layout_.rows; ++v) {
    const auto first = static_cast<Eigen::Index>(v) * width;
    Eigen::Map<Eigen::ArrayXf>(&padded_[layout_.row(v)], width) =
        roots_.segment(first, width) * image.segment(first, width);
  }
  kernels::filter_separably(layout_, taps_, padded_.data(), along_rows_.data(), shared_.data());
  for (std::size_t v = 0; v < layout_.rows; ++v) {
    const auto first = static_cast<Eigen::Index>(v) * width;
    product.segment(first, width) =
        image.segment(first, width) +
        roots_.segment(first, width) *
            Eigen::Map<const Eigen::ArrayXf>(&shared_[layout_.row(v)], width);
  }
}

/// With the last solution, unless zero is nearer.
void NoiseCovariance::begin() {
  multiply(estimate_, product_);
  left_ = right_ - product_;
  if (left_.square().sum() > right_.square().sum()) {
    estimate_.setZero();
    left_ = right_;
  }
}

std::span<const float> NoiseCovariance::solve(std::span<const float> residuals) {
  right_ = (roots_ > 0.0F).select(roots_ * whole(residuals), 0.0F);
  begin();
  direction_ = left_;
  float squares = left_.square().sum();
  const float goal = kTolerance * right_.square().sum();
  for (int step = 0; step < kMostSteps && squares > goal; ++step) {
    multiply(direction_, product_);
    const float length = squares / (direction_ * product_).sum();
    estimate_ += length * direction_;
    left_ -= length * product_;
    const float next_squares = left_.square().sum();
    direction_ = left_ + next_squares / squares * direction_;
    squares = next_squares;
  }
  solution_ = roots_ * estimate_;
  return {solution_.data(), static_cast<std::size_t>(solution_.size())};
}

}  // namespace lockbox
