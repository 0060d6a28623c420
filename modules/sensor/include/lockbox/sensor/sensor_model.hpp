// SPDX-License-Identifier: BSD-3-Clause
// What a depth sensor does to the true depth, as numbers.
//
// A pixel looks not through its centre but through a point that jitters around it. There it sees
// the depth z, that is the disparity d = fx baseline / z, to which noise is added before it is
// rounded to a multiple of the step; the depth fx baseline / d comes out in whole millimetres.
//
// A stereo camera matches windows of two images: what is in front grows over what is behind it, and
// relief within a window is averaged. Light that comes back to a time-of-flight camera's pixel
// from two surfaces is measured between them.
#pragma once

#include <string>

#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox {

/// What a depth sensor does to the true depth, number by number.
struct SensorModel {
  std::string name;  ///< of the profile that it is from
  /// The calibration of such a sensor, where nobody gives another: a PrimeSense at full resolution.
  PinholeCamera camera{640, 480, 575.8, 575.8, 319.5, 239.5};
  double baseline = 0.075;          ///< metres; disparity = camera.fx * baseline / z
  double disparity_noise = 0.0;     ///< standard deviation, pixels
  double disparity_step = 0.0;      ///< pixels; 0: disparity is not rounded
  double correlation_length = 0.0;  ///< L, pixels: disparity noise r pixels apart correlates as
                                    ///< exp(-r^2 / (2 L^2)); 0: not at all
  double lateral_jitter = 0.0;  ///< standard deviation along each axis, pixels; each pixel's own
  double depth_noise = 0.0;  ///< white noise of z: standard deviation at the reference, metres, ...
  double depth_noise_growth = 0.0;      ///< ... its growth with (z - reference)^2, 1/metres, ...
  double depth_noise_reference = 0.4;   ///< ... and that depth, metres
  bool is_weaker_when_slanted = false;  ///< white noise is divided by the cosine of the incidence
  double slant_bias = 0.0;         ///< times (1 - cosine of the incidence): z is too long, metres
  bool mixes_depths = false;       ///< a pixel takes the mean of what it sees, 1 pixel wide at half
                                   ///< the height, weighted by brightness (1 / z^2)
  int matching_window = 1;         ///< disparities are means over as many pixels squared, odd
  double least_fattening = 0.0;    ///< what is in front (by a pixel of disparity) grows by as many
  double most_fattening = 0.0;     ///< pixels, which changes along its edge
  double hole_share = 0.0;         ///< of the image, in blobs of a dozen pixels without measurement
  double dropout_rate = 0.0;       ///< share of pixels without measurement
  double edge_dropout_rate = 0.0;  ///< the same next to a jump of the disparity by over 1 pixel
  double grazing_angle = 1.570796;  ///< incidence, radians, from which on drop-outs grow to all of
                                    ///< the pixels at 90 degrees, linearly in the cosine
  bool has_projector_shadow = false;  ///< nothing is measured where the projector, at x = baseline
                                      ///< of the camera's frame, is hidden by something nearer; so
                                      ///< it is with the second camera of a stereo sensor
  double min_range = 0.0;             ///< metres; what is measured nearer or farther is dropped
  double max_range = 65.535;          ///< metres

  /// Returns whether depth comes from matching windows of two images.
  bool is_stereo() const { return matching_window > 1 || most_fattening > 0.0; }
};

}  // namespace lockbox
