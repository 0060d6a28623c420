// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/corrected_source.hpp"

#include <limits>
#include <utility>

namespace lockbox {
namespace {

constexpr std::size_t kDepths = std::size_t{1} << 16U;
constexpr float kMostUnits = std::numeric_limits<std::uint16_t>::max();

/// Returns the factors by pixel.
std::vector<float> radial_factors(const PinholeCamera& camera, double radial) {
  std::vector<float> factors;
  factors.reserve(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.back_project(u, v, 1.0);
      factors.push_back(static_cast<float>(1.0 + radial * ray.head<2>().squaredNorm()));
    }
  }
  return factors;
}

}  // namespace

CorrectedSource::CorrectedSource(std::unique_ptr<FrameSource> source,
                                 const DepthCorrection& correction)
    : source_(std::move(source)), correction_(correction) {}

/// Tables for this camera and unit, which change seldom if ever.
void CorrectedSource::prepare(const DepthFrame& frame) {
  if (metres_per_unit_ != frame.metres_per_unit) {
    metres_per_unit_ = frame.metres_per_unit;
    corrected_.assign(kDepths, 0.0F);
    for (std::size_t depth = 1; depth < kDepths; ++depth) {
      const double z = static_cast<double>(depth) * double{metres_per_unit_};
      corrected_[depth] = static_cast<float>(correction_.on_axis(z) / double{metres_per_unit_});
    }
  }
  if (camera_ != frame.camera) {
    camera_ = frame.camera;
    factors_ = radial_factors(camera_, correction_.radial);
  }
}

bool CorrectedSource::next(DepthFrame& frame) {
  if (!source_->next(frame)) return false;
  prepare(frame);
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const float depth = corrected_[frame.depth[i]] * factors_[i] + 0.5F;
    const bool is_measured = depth >= 1.0F && depth <= kMostUnits;
    frame.depth[i] = is_measured ? static_cast<std::uint16_t>(depth) : std::uint16_t{0};
  }
  return true;
}

std::string CorrectedSource::description() const {
  return source_->description() + ", depths corrected";
}

}  // namespace lockbox
