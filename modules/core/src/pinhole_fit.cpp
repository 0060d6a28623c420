// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/pinhole_fit.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

constexpr std::size_t kMinimumPoints = 100;
constexpr double kMinimumSpread = 1e-3;   // of x / z, standard deviation
constexpr double kMaximumResidual = 0.5;  // pixels, root mean square

}  // namespace

double PinholeFit::Line::slope_variance() const {
  return std::max(0.0, mean(sum_ss_) - mean(sum_s_) * mean(sum_s_));
}

double PinholeFit::Line::covariance() const {
  return mean(sum_sp_) - mean(sum_s_) * mean(sum_p_);
}

double PinholeFit::Line::spread() const {
  return std::sqrt(slope_variance());
}

double PinholeFit::Line::focal() const {
  return covariance() / slope_variance();
}

double PinholeFit::Line::centre() const {
  return mean(sum_p_) - focal() * mean(sum_s_);
}

double PinholeFit::Line::residual() const {
  const double variance = mean(sum_pp_) - mean(sum_p_) * mean(sum_p_);
  return std::sqrt(std::max(0.0, variance - focal() * covariance()));
}

bool PinholeFit::is_determined() const {
  return horizontal_.count() >= kMinimumPoints && horizontal_.spread() >= kMinimumSpread &&
         vertical_.spread() >= kMinimumSpread;
}

bool PinholeFit::is_pinhole() const {
  return residual() <= kMaximumResidual && horizontal_.focal() > 0.0 && vertical_.focal() > 0.0;
}

double PinholeFit::residual() const {
  return std::max(horizontal_.residual(), vertical_.residual());
}

PinholeCamera PinholeFit::camera(int width, int height) const {
  return {width,
          height,
          horizontal_.focal(),
          vertical_.focal(),
          horizontal_.centre(),
          vertical_.centre()};
}

}  // namespace lockbox
