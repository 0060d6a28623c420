// SPDX-License-Identifier: BSD-3-Clause
// Frames of any source with depths as they are, not as the sensor measures them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lockbox/capture/frame_source.hpp"
#include "lockbox/sensor/depth_correction.hpp"

namespace lockbox {

/// Passes all frames on, depths corrected and rounded to the source's own unit, all else as it is.
/// What the correction takes to 0, below it, or beyond what 16 bits hold is no measurement.
class CorrectedSource : public FrameSource {
 public:
  CorrectedSource(std::unique_ptr<FrameSource> source, const DepthCorrection& correction);

  bool next(DepthFrame& frame) override;
  std::optional<std::size_t> frame_count() const override { return source_->frame_count(); }
  bool is_realtime() const override { return source_->is_realtime(); }
  bool is_unit_stated() const override { return source_->is_unit_stated(); }
  std::string file_of_frame() const override { return source_->file_of_frame(); }
  SourceFaults faults() const override { return source_->faults(); }
  std::string description() const override;

 private:
  void prepare(const DepthFrame& frame);

  std::unique_ptr<FrameSource> source_;
  DepthCorrection correction_;
  PinholeCamera camera_;          ///< that the factors are for
  float metres_per_unit_ = 0.0F;  ///< that the corrected depths are for
  std::vector<float> corrected_;  ///< by measured depth, units, on the optical axis
  std::vector<float> factors_;    ///< by pixel
};

}  // namespace lockbox
