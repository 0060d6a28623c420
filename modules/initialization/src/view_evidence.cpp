// SPDX-License-Identifier: BSD-3-Clause
#include "view_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

constexpr double kContinuing = 8.0;    // exponent: how fast a contour that goes on takes belief
constexpr double kInViewEnough = 0.5;  // of the surface; with less in view, doubt grows

}  // namespace

double ViewEvidence::fit() const {
  return explained + kViolatingPixel * contradicted + kOccludedPixel * occluded;
}

double ViewEvidence::total(double tolerance) const {
  const double visible = std::min(1.0, in_view / kInViewEnough);
  const double believed = 1.0 - std::pow(continues, 1.5);
  return (explained * std::pow(believed, (1.0 - 0.7 * tolerance) * kContinuing) +
          (1.0 - 0.7 * tolerance) * kViolatingPixel * contradicted +
          (1.0 - tolerance) * kOccludedPixel * occluded) *
         visible * visible;
}

}  // namespace lockbox
