// SPDX-License-Identifier: BSD-3-Clause
#include "size_report.hpp"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace lockbox::app {
namespace {

constexpr double kPercent = 100.0;
/// What is worth a line of the summary: beyond two standard deviations, and as much as errors of
/// the measurement itself (`lockbox experiment mismatch`).
constexpr double kWorthTelling = 0.005;
constexpr double kSure = 2.0;

std::string factor_text(double factor) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << factor;
  return text.str();
}

/// "5.0 % (+- 0.2) larger than its model".
std::string difference_text(const ApparentSize& size) {
  const double off = size.value[0] - 1.0;
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << kPercent * std::abs(off) << " % (+- "
       << kPercent * std::sqrt(size.covariance(0, 0)) << ") " << (off > 0.0 ? "larger" : "smaller")
       << " than its model";
  return text.str();
}

/// What may be wrong, and what would mend it. Relief is a hint and no more: that of a real sensor
/// was 5 % off by itself.
std::string causes_text(const ApparentSize& size) {
  const std::string factor = factor_text(size.value[0]);
  const auto doubt = [](bool may_be) { return may_be ? "" : "; its relief speaks against it"; };
  return "\n  - the model: its lengths times " + factor +
         " would fit (unit of the meshes: --mesh-scale)" + doubt(size.may_be_scale()) +
         "\n  - the depths: divided by " + factor +
         " they would fit (their unit: --depth-scale; depth_correction in a sensor's profile)" +
         doubt(size.may_be_scale()) + "\n  - the focal length: times " + factor +
         " it would fit (--camera-info)" + doubt(size.may_be_focal_length());
}

}  // namespace

std::string size_sentence(const ApparentSize& size) {
  return "the object looks " + difference_text(size) +
         ": scale of the model (--mesh-scale), or of the depths (--depth-scale), or focal length "
         "(--camera-info)";
}

void SizeReport::look_at(const TrackingResult& result) {
  if (is_said_ || !result.size.is_implausible()) return;
  is_said_ = true;
  std::cerr << "lockbox: warning: by its contours, at the distance of its faces, the object looks "
            << difference_text(result.size)
            << "; it is not called tracking while that is so. One of these may be wrong:"
            << causes_text(result.size) << '\n';
}

void SizeReport::print_summary(std::ostream& out, const RunTotals& totals) {
  const ApparentSize size = totals.size();
  const double off = std::abs(size.value[0] - 1.0);
  if (off < kWorthTelling || off < kSure * std::sqrt(size.covariance(0, 0))) return;
  out << size_sentence(size) << '\n';
}

}  // namespace lockbox::app
