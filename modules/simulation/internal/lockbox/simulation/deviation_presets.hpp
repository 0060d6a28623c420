// SPDX-License-Identifier: BSD-3-Clause
// Deviations as one meets them: how far objects are from their drawings and cameras from their
// calibration, one kind at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/core/units.hpp"
#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/simulation/deviation.hpp"

namespace lockbox {

/// `moderate`: what careful people meet; `severe`: what an object may have and still be the
/// model's. All amounts follow from experience with furniture, wooden models and factory
/// calibrations.
struct DeviationAmounts {
  double scale;            ///< share, either way
  double sizes;            ///< metres, see ObjectDeviation
  double bend;             ///< metres
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

inline constexpr DeviationAmounts kModerateDeviation{
    .scale = 0.01,
    .sizes = 0.002,
    .bend = 0.005,
    .joint_origins = 0.003,
    .joint_axes = 0.5 * kRadians,
    .added_parts = 3,
    .added_share = 0.0,
    .focal_length = 0.015,
    .principal_point = 6.0,
    .k1 = 0.06,
    .k2 = -0.15,
    .depth_scale = 0.01,
    .depth_bend = 0.006,
    .depth_corners = 0.02,
    .rate = 15.0,
    .repeated = 0.1,
    .missing = 0.0,
};

inline constexpr DeviationAmounts kSevereDeviation{
    .scale = 0.02,
    .sizes = 0.005,
    .bend = 0.012,
    .joint_origins = 0.008,
    .joint_axes = 1.5 * kRadians,
    .added_parts = 3,
    .added_share = 0.15,
    .focal_length = 0.03,
    .principal_point = 12.0,
    .k1 = 0.12,
    .k2 = -0.3,
    .depth_scale = 0.02,
    .depth_bend = 0.015,
    .depth_corners = 0.04,
    .rate = 10.0,
    .repeated = 0.0,
    .missing = 0.2,
};

enum class Severity { moderate, severe };

/// `none`, `scale`, `sizes`, `bend`, `joints`, `added`, `missing`, `focal`, `centre`, `distortion`,
/// `depth-scale`, `depth-bend`, `frames` and `all`, which is a third of everything moderate but
/// what comes in whole pieces, or a half.
const std::vector<std::string>& deviation_kinds();

/// A deviation of one of these kinds; the seed decides signs and directions, and what is drawn of
/// them later. `missing` is a handle, or, severe, a whole moving part. None where the model has
/// nothing that could deviate so.
std::optional<Deviation> preset_deviation(const std::string& kind, Severity severity,
                                          std::uint64_t seed, const KinematicTree& tree);

}  // namespace lockbox
