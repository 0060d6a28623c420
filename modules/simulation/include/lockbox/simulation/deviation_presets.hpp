// SPDX-License-Identifier: BSD-3-Clause
// Deviations as one meets them: how far objects are from their drawings and cameras from their
// calibration, one kind at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/simulation/deviation.hpp"

namespace lockbox {

/// `moderate`: what careful people meet; `severe`: what an object may have and still be the
/// model's. All amounts follow from experience with furniture, wooden models and factory
/// calibrations.
struct DeviationAmounts {
  double scale;            ///< share, either way
  double sizes;            ///< metres, see ObjectDeviation
  double joint_origins;    ///< metres
  double joint_axes;       ///< radians
  int added_parts;         ///< number
  double added_share;      ///< of the front
  double focal_length;     ///< share, either way
  double principal_point;  ///< pixels, in any direction
  double k1;               ///< see CameraDeviation
  double k2;
  double depth_scale;    ///< share, either way
  double depth_bend;     ///< 1/metre, either way
  double depth_corners;  ///< share, the same way
  double rate;           ///< frames a second
  double repeated;       ///< share of frames
  double missing;        ///< share of frames
};

inline constexpr double kHalfDegree = 0.008726646;

inline constexpr DeviationAmounts kModerateDeviation{0.01,  0.002, 0.003, kHalfDegree, 3,    0.0,
                                                     0.015, 6.0,   0.06,  -0.15,       0.01, 0.006,
                                                     0.02,  15.0,  0.1,   0.0};
inline constexpr DeviationAmounts kSevereDeviation{
    0.02, 0.005, 0.008, 3.0 * kHalfDegree, 3, 0.15, 0.03, 12.0, 0.12, -0.3, 0.02, 0.015, 0.04,
    10.0, 0.0,   0.2};

enum class Severity { moderate, severe };

/// `none`, `scale`, `sizes`, `joints`, `added`, `missing`, `focal`, `centre`, `distortion`,
/// `depth-scale`, `depth-bend`, `frames` and `all`, which is a third of everything moderate but
/// what comes in whole pieces, or a half.
const std::vector<std::string>& deviation_kinds();

/// A deviation of one of these kinds; the seed decides signs and directions, and what is drawn of
/// them later. `missing` is a handle, or, severe, a whole moving part. None where the model has
/// nothing that could deviate so.
std::optional<Deviation> preset_deviation(const std::string& kind, Severity severity,
                                          std::uint64_t seed, const KinematicTree& tree);

}  // namespace lockbox
