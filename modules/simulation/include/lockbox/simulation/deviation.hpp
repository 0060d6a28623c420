// SPDX-License-Identifier: BSD-3-Clause
// How a simulation differs from the model and from the calibration, without a tracker being told.
// All that is drawn at random follows from the seed.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lockbox {

/// What was built, against what was drawn.
struct ObjectDeviation {
  double scale = 1.0;          ///< of the whole object, about the origin of its base
  double sizes = 0.0;          ///< edge lengths of each part differ by up to this, metres
  double bend = 0.0;           ///< its base bows by this along its longest extent, metres
  double joint_origins = 0.0;  ///< how far each joint's origin is off, metres
  double joint_axes = 0.0;     ///< how far each joint's axis is tilted, radians
  int added_parts = 0;         ///< how many parts of 3 to 30 cm the model lacks, at least
  double added_share = 0.0;    ///< of the object's front that such parts cover, at least
  int missing_handles = 0;     ///< how many pieces that stand out of a part's front are missing
  std::vector<std::string> missing_parts =
      {};  ///< links that are missing, with all that they carry
};

/// The camera that takes the images, against the calibration that comes with them.
struct CameraDeviation {
  double focal_length = 1.0;                                  ///< factor
  Eigen::Vector2d principal_point = Eigen::Vector2d::Zero();  ///< it is off by this, pixels
  /// k1, k2 of plumb_bob: r becomes r (1 + k1 r^2 + k2 r^4), which nobody undoes.
  Eigen::Vector2d distortion = Eigen::Vector2d::Zero();
};

/// A surface at depth z is measured at z (scale + bend z + corners r^2), where r is the distance
/// from the principal point as a share of that of the farthest corner.
struct DepthDeviation {
  double scale = 1.0;    ///< metres a metre
  double bend = 0.0;     ///< 1/metre
  double corners = 0.0;  ///< share of the depth in the farthest corner
};

/// How camera and depths differ from the calibration that comes with them.
struct SensorDeviation {
  CameraDeviation camera;  ///< the geometry of the image
  DepthDeviation depth;    ///< what is measured in it

  /// Returns whether anything differs at all.
  bool is_any() const {
    return camera.focal_length != 1.0 || !camera.principal_point.isZero(0.0) ||
           !camera.distortion.isZero(0.0) || depth.scale != 1.0 || depth.bend != 0.0 ||
           depth.corners != 0.0;
  }
};

/// What becomes of the frames on their way.
struct FrameDeviation {
  double rate = 0.0;      ///< frames a second that arrive at most; 0: all of them
  double repeated = 0.0;  ///< share of frames that show the image before once more
  double missing = 0.0;   ///< share of frames that do not arrive
};

/// How what is simulated differs from what the tracker is told.
struct Deviation {
  std::uint64_t seed = 1;  ///< of all that is drawn at random
  ObjectDeviation object;  ///< against its model
  SensorDeviation sensor;  ///< `camera` and `depth` in a file
  FrameDeviation frames;   ///< what is lost or repeated on the way
};

/// Reads a deviation file; its keys are the names of the members above (docs/file-formats.md).
/// Throws InputError with file, line and key.
Deviation read_deviation(const std::filesystem::path& file);

/// Returns the text of a file that read_deviation() reads, all keys written out.
std::string deviation_text(const Deviation& deviation);

}  // namespace lockbox
