// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "lockbox/tracking/tracker.hpp"

namespace lockbox {
namespace {

/// What objects and cameras may be off: of consumer depth cameras, focal lengths by 1.5 % and
/// depths by 2 % at most (`lockbox experiment mismatch`, moderate and severe). Doubled, a mesh that
/// is 5 % too small is not noticed.
constexpr double kPlausible = 0.03;
constexpr double kBeyondDoubt = 2.0;  // standard deviations
constexpr double kExcluded = 3.0;     // standard deviations, of a cause that does not fit

/// Whether direction . (value - 1) may be 0.
bool vanishes(const ApparentSize& size, const Eigen::Vector2d& direction) {
  const double off = direction.dot(size.value - Eigen::Vector2d::Ones());
  return std::abs(off) <= kExcluded * std::sqrt(direction.dot(size.covariance * direction));
}

}  // namespace

bool ApparentSize::is_implausible() const {
  return std::abs(value[0] - 1.0) > kPlausible + kBeyondDoubt * std::sqrt(covariance(0, 0));
}

bool ApparentSize::may_be_scale() const {
  return vanishes(*this, {1.0, -1.0}) || !vanishes(*this, {0.0, 1.0});
}

bool ApparentSize::may_be_focal_length() const {
  return vanishes(*this, {0.0, 1.0}) || !vanishes(*this, {1.0, -1.0});
}

}  // namespace lockbox
